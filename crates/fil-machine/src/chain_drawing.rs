//! The chain of axes of a machine drawn, as text and as SVG: from the part over the tables
//! to X, Y and Z, and over the heads to the tool.

use std::fmt::Write as _;

use nalgebra::Vector3;

use crate::axis_chain::{AxisChain, Carries, Rotary};
use crate::commons::{Commons, EMPTY};
use crate::errors::MachineCode;
use crate::locations as loc;
use crate::zones::Zones;
use fil_diag::{Diag, Result};

/// Height and width of a link of the chain in the picture, and the way between two.
const LINK: [u32; 3] = [46, 520, 26];

/// A link of the chain.
struct Link {
    name: String,
    details: Vec<String>,
}

/// The chain as lines of text.
///
/// # Errors
/// A direction of length zero.
pub fn text(commons: &Commons) -> Result<String, Box<Diag>> {
    let mut text = String::new();
    for (depth, link) in links(commons)?.iter().enumerate() {
        let indent = "   ".repeat(depth.saturating_sub(1));
        let branch = if depth == 0 { "" } else { "└─ " };
        let _ = writeln!(text, "{indent}{branch}{}", link.name);
        let indent = "   ".repeat(depth);
        for detail in &link.details {
            let _ = writeln!(text, "{indent}   {detail}");
        }
    }
    Ok(text)
}

/// The chain as a picture.
///
/// # Errors
/// As [`text`].
pub fn svg(commons: &Commons) -> Result<String, Box<Diag>> {
    let links = links(commons)?;
    let [height, width, gap] = LINK;
    let whole = links.len() as u32 * (height + gap) - gap + 4;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{whole}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n",
        width + 4
    );
    for (number, link) in links.iter().enumerate() {
        let top = 2 + number as u32 * (height + gap);
        let fill = if number == 0 || number + 1 == links.len() { "#e8eef7" } else { "#ffffff" };
        let _ = writeln!(
            svg,
            "<rect x=\"2\" y=\"{top}\" width=\"{width}\" height=\"{height}\" rx=\"6\" \
             fill=\"{fill}\" stroke=\"#33475b\"/>\n<text x=\"14\" y=\"{}\" \
             font-weight=\"bold\">{}</text>\n<text x=\"14\" y=\"{}\" fill=\"#33475b\">{}</text>",
            top + 19,
            link.name,
            top + 37,
            link.details.join("; ")
        );
        if number + 1 < links.len() {
            let (x, y) = (width / 2, top + height);
            let _ = writeln!(
                svg,
                "<path d=\"M{x} {y} v{} m-4 -6 l4 6 l4 -6\" fill=\"none\" stroke=\"#33475b\"/>",
                gap - 2
            );
        }
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

fn links(commons: &Commons) -> Result<Vec<Link>, Box<Diag>> {
    let chain = AxisChain::from_commons(commons)
        .map_err(|diag| MachineCode::SettingValue.diag(diag.message.clone()))?;
    let of = |carries| {
        let rotaries = chain.rotaries.iter().enumerate();
        rotaries.filter_map(move |(index, rotary)| {
            rotary.as_ref().filter(|rotary| rotary.carries == carries).map(|r| (index, r))
        })
    };
    let mut links = vec![Link { name: "part".into(), details: Vec::new() }];
    links.extend(of(Carries::Table).map(|(index, rotary)| turning(commons, index, rotary)));
    links.push(linear(commons));
    links.extend(of(Carries::Head).map(|(index, rotary)| turning(commons, index, rotary)));
    let mut details = vec![format!("along {}", direction(chain.tool.into_inner()))];
    details.push(match chain.pivot {
        Some(length) => format!("its tip {} mm from the pivot", number(length)),
        None if of(Carries::Head).next().is_some() => {
            "the control keeps the tip in place".to_string()
        }
        None => "no pivot".to_string(),
    });
    links.push(Link { name: "tool".into(), details });
    Ok(links)
}

fn turning(commons: &Commons, index: usize, rotary: &Rotary) -> Link {
    let what = match rotary.carries {
        Carries::Table => "table",
        Carries::Head => "head",
    };
    let order = ["primary", "secondary"][index];
    let center = rotary.center;
    let mut travel = match (rotary.min, rotary.max) {
        (None, None) => "any turn".to_string(),
        (min, max) => format!("{} to {} degrees", bound(min), bound(max)),
    };
    let Zones { ranges, zone } = rotary.zones;
    for [low, high] in ranges.into_iter().chain([zone]).flatten() {
        travel += &format!(", within {} to {}", number(low), number(high));
    }
    let mut details = vec![
        format!(
            "about {} through {}, {}, {}",
            direction(rotary.direction.into_inner()),
            number(center.x),
            number(center.y),
            number(center.z)
        ),
        travel,
    ];
    let rate = |name, what: &str| {
        let row = loc::Location::named(name)?;
        let rate = commons.get(row.kind, u32::from(row.number)).ok()?;
        (rate != EMPTY).then(|| format!("{what} {} degrees a minute", number(rate)))
    };
    details.extend(rate("rotary.feed_max", "feed up to"));
    details.extend(rate("rotary.rapid_rate", "rapid"));
    Link { name: format!("{what} {} ({order})", rotary.letter), details }
}

fn linear(commons: &Commons) -> Link {
    let checked = commons.read(loc::LIMITS_CHECK);
    let travel = |(min, max), letter: char| {
        let (min, max) = (commons.dbl_opt(min), commons.dbl_opt(max));
        let given = checked && (min.is_some() || max.is_some());
        given.then(|| format!("{letter} {} to {}", bound(min), bound(max)))
    };
    let limits = loc::LINEAR_LIMITS.into_iter().zip(['X', 'Y', 'Z']);
    let mut details: Vec<String> = limits.filter_map(|(at, letter)| travel(at, letter)).collect();
    if details.is_empty() {
        details.push("travel not checked".into());
    }
    Link { name: "X, Y, Z".into(), details }
}

fn bound(at: Option<f64>) -> String {
    at.map_or_else(|| "any".to_string(), number)
}

fn direction(vector: Vector3<f64>) -> String {
    let named = ["X", "Y", "Z"].into_iter().zip([Vector3::x(), Vector3::y(), Vector3::z()]);
    for (name, axis) in named {
        if (vector - axis).norm() < 1e-9 {
            return name.to_string();
        }
        if (vector + axis).norm() < 1e-9 {
            return format!("-{name}");
        }
    }
    format!("({}, {}, {})", number(vector.x), number(vector.y), number(vector.z))
}

/// At most four digits after the point.
fn number(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
