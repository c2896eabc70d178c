//! How many words must be put in or taken out to make one program of another.

/// Insertions and deletions between two sequences; `None` where there are more than `most`.
pub(crate) fn distance(mut a: &[u64], mut b: &[u64], most: usize) -> Option<usize> {
    let same = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    (a, b) = (&a[same..], &b[same..]);
    let same = a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| a == b).count();
    (a, b) = (&a[..a.len() - same], &b[..b.len() - same]);
    if a.is_empty() || b.is_empty() {
        return Some(a.len() + b.len()).filter(|edits| *edits <= most);
    }
    let (n, m) = (a.len() as isize, b.len() as isize);
    let most = most.min(a.len() + b.len()) as isize;
    // furthest[k + offset]: how far in `a` the diagonal k has come.
    let offset = most + 1;
    let mut furthest = vec![0isize; 2 * offset as usize + 1];
    for edits in 0..=most {
        for k in (-edits..=edits).step_by(2) {
            // Beyond these diagonals one of both sequences is over.
            if k > n || -k > m {
                continue;
            }
            let at = (k + offset) as usize;
            let down = k == -edits || (k != edits && furthest[at - 1] < furthest[at + 1]);
            let mut x = if down { furthest[at + 1] } else { furthest[at - 1] + 1 };
            let mut y = x - k;
            while x < n && y < m && x >= 0 && y >= 0 && a[x as usize] == b[y as usize] {
                (x, y) = (x + 1, y + 1);
            }
            furthest[at] = x;
            if x >= n && y >= m {
                return Some(edits as usize);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the table that all textbooks have.
    fn by_table(a: &[u64], b: &[u64]) -> usize {
        let mut row: Vec<usize> = (0..=b.len()).collect();
        for (i, x) in a.iter().enumerate() {
            let mut before = row[0];
            row[0] = i + 1;
            for (j, y) in b.iter().enumerate() {
                let one_less = row[j + 1].min(row[j]) + 1;
                let next = if x == y { before } else { one_less };
                before = std::mem::replace(&mut row[j + 1], next);
            }
        }
        row[b.len()]
    }

    #[test]
    fn agrees_with_the_table() {
        let mut state = 7u64;
        let mut next = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) % below
        };
        for _ in 0..500 {
            let make = |next: &mut dyn FnMut(u64) -> u64| {
                let length = next(12);
                (0..length).map(|_| next(4)).collect::<Vec<u64>>()
            };
            let (a, b) = (make(&mut next), make(&mut next));
            let right = by_table(&a, &b);
            assert_eq!(distance(&a, &b, 1000), Some(right), "{a:?} {b:?}");
            assert_eq!(distance(&a, &b, right), Some(right), "{a:?} {b:?}");
            if right > 0 {
                assert_eq!(distance(&a, &b, right - 1), None, "{a:?} {b:?}");
            }
        }
    }
}
