//! Turns `src/grammar.lalrpop` into the parser.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    lalrpop::process_src()
}
