//! The page of a plot in a real browser: how fast it opens, and how it follows the hand.

use std::path::Path;

use filpost_tests::browser;
use serde_json::Value;

use super::{Outcome, word};

/// Most MB of a page of 1.5 million motions, most seconds until it is there, and most
/// milliseconds between two pictures while a hand moves it.
const SIZE: f64 = 25.0;
const OPENS: f64 = 3.0;
const FRAME: f64 = 100.0;

/// Largest program whose page is opened, in parts of 1.5 million blocks: browsers are made for
/// less, and the path of a longer CL file does not lie in memory.
pub const MOST: f64 = 1.5;

/// Seconds in which a page must say how it was.
const PATIENCE: u64 = 120;

/// Says how large a page is, and how it was in a browser; `share` is its part of 1.5 million
/// blocks.
pub fn report(page: &Path, share: f64) -> Outcome<()> {
    let size = std::fs::metadata(page)?.len() as f64 / 1e6;
    let most = SIZE * share.max(0.1);
    println!(
        "{:>20} page of the plot: {size:.1} MB, at most {most:.1} MB {}",
        "",
        word(size <= most)
    );
    if share > MOST {
        println!("{:>20} it is not opened", "");
        return Ok(());
    }
    let Some(browser) = browser::program() else { return Ok(()) };
    let script = include_str!("../../plot/measure.js");
    let page = std::fs::read_to_string(page)?;
    let page = page.replace("</body>", &format!("<script>{script}</script></body>"));
    let said: Value = serde_json::from_str(&browser::said(&browser, &page, PATIENCE)?)?;
    let opened = said["opened"].as_f64().ok_or("a page that opens")? / 1000.0;
    println!("{:>20} it opens in {opened:.2} s, at most {OPENS} s {}", "", word(opened <= OPENS));
    for hand in ["zoom", "drag", "turn", "hover"] {
        let [mean, longest] =
            ["mean", "longest"].map(|key| said[hand][key].as_f64().unwrap_or(f64::NAN));
        println!(
            "{:>20} {hand}: a picture in {mean:.0} ms, the slowest in {longest:.0} ms, at most {FRAME} ms {}",
            "",
            word(longest <= FRAME)
        );
    }
    Ok(())
}
