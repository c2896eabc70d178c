//! Playback, filters and the keyboard of a backplot's page, in a real browser.

use filpost::Program;
use filpost::nc::plot::{CL_COLOUR, Stroke, html};
use filpost::plot::{self, Text};
use filpost_tests::browser;
use serde_json::Value;

/// What `tests/plot/hands.js` says of the page of a program; `None` without a browser.
fn said(ready: &str, nc: &str) -> Option<Value> {
    let browser = browser::program()?;
    let post = Program::builder().generic(ready).build().unwrap();
    let text = Text { name: "out.nc", bytes: nc.as_bytes() };
    let page = html(&plot::program(text, post.commons()).unwrap());
    let script = include_str!("../../plot/hands.js");
    let page = page.replace("</body>", &format!("<script>{script}</script></body>"));
    let dom = browser::dom(&browser, &page, 30).unwrap();
    let (_, answer) = dom.split_once("<pre id=\"said\">").expect("an answer");
    let answer = answer.split("</pre>").next().unwrap_or_default();
    let answer = answer.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    let said: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(said["error"], Value::Null, "{said:#}");
    Some(said)
}

/// The number behind a letter in what is said of a place.
fn number(place: &str, letter: &str) -> f64 {
    let found = place.split(' ').find_map(|word| word.strip_prefix(letter)?.parse().ok());
    found.unwrap_or_else(|| panic!("no {letter} in {place}"))
}

/// At each speed the tool stands where the feeds bring it in the time that went by.
fn plays(said: &Value, place_after: impl Fn(f64) -> Vec<(&'static str, f64)>) {
    let played = said["played"].as_array().expect("a list");
    assert_eq!(played.len(), 3, "{said:#}");
    for one in played {
        let seconds = one["speed"].as_f64().unwrap() * one["seconds"].as_f64().unwrap();
        assert!(seconds > 0.5, "{one}");
        let place = one["place"].as_str().unwrap();
        for (letter, wanted) in place_after(seconds) {
            let found = number(place, letter);
            // Some milliseconds pass between the two looks at the clock.
            let allowed = 0.02 * wanted.abs() + 0.02;
            assert!((found - wanted).abs() < allowed, "{letter}{wanted} after {seconds}: {one}");
        }
    }
}

/// Three operations of two tools: 0 to 10, 20 to 30 and 40 to 50 in X, the middle one in
/// another offset, the last one lower. Before them 75 s of straight way and 75 s of arc.
const MILL: &str = "\
G21 G90 G94 G17
T1 M6
G54 G0 X0. Y0. Z0.
S900 M3
G1 X10. F8.
G3 X0. Y10. I-10. J0. F12.5664
G0 Z5.
T2 M6
S900 M3
G55 G0 X20. Y0.
G1 Z0. F500.
X30.
G0 Z5.
T1 M6
S900 M3
G54 G0 X40. Y0.
G1 Z-1. F500.
X50.
G0 Z5.
M30
";

/// Where X of a group of columns lies, of all of `MILL`.
fn extents(groups: &Value, all: (f64, f64)) -> Vec<(i64, i64)> {
    let share = |x: &Value| ((x.as_f64().unwrap() - all.0) / (all.1 - all.0) * 50.0).round() as i64;
    let groups = groups.as_array().expect("groups");
    groups.iter().map(|group| (share(&group[0]), share(&group[1]))).collect()
}

#[test]
fn a_mill_plays_by_its_feeds_and_shows_what_the_filters_say() {
    let Some(said) = said("fanuc-mill", MILL) else { return };
    plays(&said, |seconds| {
        if seconds <= 75.0 {
            return vec![("X", 10.0 * seconds / 75.0), ("Y", 0.0)];
        }
        // A quarter of 15.708 mm at 12.5664 mm/min.
        let angle = std::f64::consts::FRAC_PI_2 * (seconds - 75.0) / 75.0;
        vec![("X", 10.0 * libm::cos(angle)), ("Y", 10.0 * libm::sin(angle))]
    });
    let all = said["filtered"]["all tools"].as_array().expect("groups");
    let edge = |at: usize, side: usize| all[at][side].as_f64().unwrap();
    let all = (edge(0, 0), edge(all.len() - 1, 1));
    let shown = |text: &str| extents(&said["filtered"][text], all);
    assert_eq!(shown("all tools"), [(0, 10), (20, 30), (40, 50)], "{said:#}");
    assert_eq!(shown("T1 in 2 operations"), [(0, 10), (40, 50)]);
    assert_eq!(shown("1: T1 from line 5"), [(0, 10)]);
    assert_eq!(shown("3: T1 from line 18"), [(40, 50)]);
    assert_eq!(extents(&said["levels"], all), [(40, 50)], "{said:#}");
}

#[test]
fn the_page_needs_no_mouse() {
    let Some(said) = said("fanuc-mill", MILL) else { return };
    let text = |name: &str| said[name].as_str().unwrap_or_default().to_string();
    assert_eq!(
        text("stepped"),
        "line 6 · X0 Y10 Z0 · T1 · G54 · F 12.566 mm/min · S 900 rpm · clockwise · after 0:02:30"
    );
    assert_eq!(text("row"), "8T2 M6");
    assert_eq!(text("line"), "line 8");
    let near = |name: &str, wanted: f64, off: f64| {
        assert!((said[name].as_f64().unwrap() - wanted).abs() < off, "{name}: {said:#}");
    };
    // Some of the path lies beside the canvas then.
    assert!(said["larger"].as_f64() > Some(1.02), "{said:#}");
    near("moved", -60.0, 1.5);
    near("fitted", 0.0, 1.5);
    assert_eq!((&text("view")[..], &text("plays")[..]), ("iso", "true"));
    assert_eq!(said["unreachable"], serde_json::json!([]));
    let themes = said["themes"].as_array().expect("two themes");
    assert_ne!(themes[0], themes[1], "{said:#}");
}

/// 0.2 mm a turn at 100 m/min on a diameter of 40: 159.1549 mm/min.
#[test]
fn a_lathe_plays_by_its_surface_speed() {
    let nc = "G21 G18\nT0101\nG50 S3000\nG96 S100 M3\nG0 X40. Z0.\nG99 G1 Z-100. F0.2\nX44.\nG0 Z5.\n\
              G1 X30. F0.5\nM30\n";
    let Some(said) = said("fanuc-lathe", nc) else { return };
    let feed = 0.2 * 100_000.0 / (std::f64::consts::PI * 40.0);
    plays(&said, |seconds| match seconds * feed / 60.0 {
        way if way < 100.0 => vec![("Z", -way), ("\u{2300}", 40.0)],
        _ => vec![],
    });
}

/// 90 degrees of C at a radius of 20 in 1/0.8 minutes: 31.416 mm of arc in 75 s.
#[test]
fn five_axes_play_by_inverse_time() {
    let nc = "G21 G90 G94 G17\nM6 T1\nG0 X20. Y0. Z0. A0. C0.\nS900 M3\nG93 G1 C90. F0.8\nC180. F0.8\nG94\nM30\n";
    let Some(said) = said("fanuc-5x-tables", nc) else { return };
    plays(&said, |seconds| {
        let angle = (90.0 * seconds / 75.0).to_radians();
        vec![("X", 20.0 * libm::cos(angle)), ("Z", 0.0)]
    });
}

/// Relative luminance of a colour, `#rrggbb`, as WCAG 2 defines it.
fn luminance(colour: &str) -> f64 {
    let part = |at: usize| {
        let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
    };
    0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
}

/// Lines are told from the paper in the light and in the dark: 3 to 1, as WCAG 2 asks of
/// graphics. The path under them is a wide band.
#[test]
fn lines_stand_out_in_the_light_and_in_the_dark() {
    for paper in ["#ffffff", "#16181b"] {
        for line in Stroke::ALL.map(Stroke::colour) {
            let [low, high] = {
                let (one, other) = (luminance(line), luminance(paper));
                [one.min(other), one.max(other)]
            };
            let contrast = (high + 0.05) / (low + 0.05);
            assert!(contrast >= 3.0, "{line} on {paper}: {contrast:.2}");
        }
        let band = luminance(CL_COLOUR);
        assert!((band - luminance(paper)).abs() > 0.3);
    }
}
