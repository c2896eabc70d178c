//! The loop of the bench of speed, in Rhai: says when it starts, then the results.

use std::io::Write;

const LOOP: &str = "
let xx = 0.0;
let nn = 0.0;
for ii in 1..=10000000 {
    xx += ii * 2.0;
    if xx > 1000000.0 {
        xx -= 1000000.0;
        nn += 1.0;
    }
}
[xx, nn]
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let engine = rhai::Engine::new();
    let program = engine.compile(LOOP)?;
    println!("start");
    std::io::stdout().flush()?;
    let results: rhai::Array = engine.eval_ast(&program)?;
    let numbers: Vec<String> = results.iter().map(ToString::to_string).collect();
    println!("{}", numbers.join(" "));
    Ok(())
}
