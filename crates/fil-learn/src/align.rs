//! Which blocks of two programs belong together.

use std::ops::Range;

/// Largest table of the longest common subsequence; longer middles are left unmatched.
const LARGEST_TABLE: usize = 16_000_000;

/// Pairs of indexes of equal items, rising in both: a longest common subsequence.
pub(crate) fn matches(a: &[u64], b: &[u64]) -> Vec<(usize, usize)> {
    let before = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    let (middle_a, middle_b) = (&a[before..], &b[before..]);
    let after = middle_a.iter().rev().zip(middle_b.iter().rev());
    let after = after.take_while(|(a, b)| a == b).count();
    let middle_a = &middle_a[..middle_a.len() - after];
    let middle_b = &middle_b[..middle_b.len() - after];
    let mut found: Vec<(usize, usize)> = (0..before).map(|at| (at, at)).collect();
    found.extend(by_table(middle_a, middle_b).into_iter().map(|(i, j)| (i + before, j + before)));
    found.extend((0..after).map(|at| (a.len() - after + at, b.len() - after + at)));
    found
}

/// Runs of items that belong to none of the other list, in both lists; one of the two may be empty.
pub(crate) fn gaps(a: &[u64], b: &[u64]) -> Vec<(Range<usize>, Range<usize>)> {
    let (mut i, mut j, mut gaps) = (0, 0, Vec::new());
    for (to_i, to_j) in matches(a, b).into_iter().chain([(a.len(), b.len())]) {
        if i != to_i || j != to_j {
            gaps.push((i..to_i, j..to_j));
        }
        (i, j) = (to_i + 1, to_j + 1);
    }
    gaps
}

fn by_table(a: &[u64], b: &[u64]) -> Vec<(usize, usize)> {
    let width = b.len() + 1;
    if a.is_empty() || b.is_empty() || (a.len() + 1) * width > LARGEST_TABLE {
        return Vec::new();
    }
    // longest[i * width + j]: of a[i..] and b[j..].
    let mut longest = vec![0u16; (a.len() + 1) * width];
    for i in (0..a.len()).rev() {
        for j in (0..b.len()).rev() {
            longest[i * width + j] = if a[i] == b[j] {
                longest[(i + 1) * width + j + 1] + 1
            } else {
                longest[(i + 1) * width + j].max(longest[i * width + j + 1])
            };
        }
    }
    let (mut i, mut j, mut found) = (0, 0, Vec::new());
    while i < a.len() && j < b.len() {
        if a[i] == b[j] {
            found.push((i, j));
            (i, j) = (i + 1, j + 1);
        } else if longest[(i + 1) * width + j] >= longest[i * width + j + 1] {
            i += 1;
        } else {
            j += 1;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_items_are_matched_in_order() {
        assert_eq!(
            matches(&[1, 2, 3, 4, 8, 9], &[1, 3, 2, 4, 7, 9]),
            [(0, 0), (2, 1), (3, 3), (5, 5)]
        );
        assert_eq!(matches(&[], &[1]), []);
    }

    #[test]
    fn what_is_not_matched_are_gaps() {
        assert_eq!(gaps(&[1, 2, 4], &[1, 3, 4, 5]), [(1..2, 1..2), (3..3, 3..4)]);
        assert_eq!(gaps(&[1], &[1]), []);
    }
}
