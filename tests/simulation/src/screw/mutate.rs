//! Changed programs: each motion word of a block changed, the block left out.

/// A changed program.
pub struct Mutation {
    /// What was changed.
    pub what: String,
    /// The program.
    pub nc: String,
}

/// What a word is changed to: X and Z by 0.1 mm, A by 5 degrees, a feed by a tenth,
/// rapid and feed the other way round.
fn changed(word: &str) -> Vec<String> {
    let (letter, number) = word.split_at(1);
    let Ok(value) = number.parse::<f64>() else { return Vec::new() };
    let by = |change: f64| {
        [value - change, value + change].map(|value| format!("{letter}{value:.5}")).to_vec()
    };
    match (letter, number) {
        ("G", "0") => vec!["G1".to_string()],
        ("G", "1") => vec!["G0".to_string()],
        ("X" | "Z", _) => by(0.1),
        ("A", _) => by(5.0),
        ("F", _) => by(value / 10.0),
        _ => Vec::new(),
    }
}

/// All changes of a block, by its index among the lines.
pub fn mutations(nc: &str, index: usize) -> Vec<Mutation> {
    let lines: Vec<&str> = nc.lines().collect();
    let block = lines[index];
    let with = |new: &[String]| {
        let new = new.join(" ");
        [&lines[..index], &[new.as_str()], &lines[index + 1..]].concat().join("\n")
    };
    let words: Vec<String> = block.split(' ').map(String::from).collect();
    let mut all = vec![Mutation { what: format!("without {block}"), nc: with(&[]) }];
    for (place, word) in words.iter().enumerate() {
        for new in changed(word) {
            let what = format!("{word} is {new} in {block}");
            let mut words = words.clone();
            words[place] = new;
            all.push(Mutation { what, nc: with(&words) });
        }
    }
    all
}
