//! The form with look-ahead: F in each block.

use filpost_tests::feed::{Cutting, Floor, LISTING, Point, pass};
use proptest::prelude::*;

use super::{cuts, pass_cl, points, post};

/// A CL file of one pass.
fn cl_of(cutting: Cutting, points: &[Point]) -> String {
    let Cutting { ball, stock, speed, feed } = cutting;
    let mut cl = format!(
        "UNITS / MM\nSPINDL / RPM, {speed}, CLW\nFEDRAT / {feed}, MMPM\n\
         FEDCTL / ON, RADIUS, {ball}, STOCK, {stock}\nRAPID\n"
    );
    for [x, y, z] in points {
        cl += &format!("GOTO / {x}, {y}, {z}\n");
    }
    let [x, y, _] = points[0];
    cl + &format!("FEDCTL / OFF\nRAPID\nGOTO / {x}, {y}, 400\nFINI\n")
}

/// The feeds of the NC program beside those of the formulas.
fn both(cutting: Cutting, cl: &str, points: &[Point]) -> Vec<(f64, f64)> {
    let (nc, warnings) = post(Some("feed-ahead.fil"), cl).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    let cuts = cuts(&nc);
    let expected = pass(cutting, points, Floor::Formula);
    assert_eq!(cuts.len(), expected.len());
    cuts.iter().map(|(_, feed)| *feed).zip(expected.iter().map(|contact| contact.feed)).collect()
}

#[test]
fn each_block_has_the_feed_of_the_formulas() {
    let cl = pass_cl();
    let points = points(&cl);
    for (index, (found, formula)) in both(LISTING, &cl, &points).into_iter().enumerate() {
        assert!((found - formula).abs() <= 0.000_5 + 1e-9, "cut {index}: F{found}, not {formula}");
    }
    let (nc, _) = post(Some("feed-ahead.fil"), &cl).unwrap();
    for ((found, _), point) in cuts(&nc).into_iter().zip(&points[1..]) {
        assert!((0..3).all(|axis| (found[axis] - point[axis]).abs() < 0.000_501));
    }
}

/// On a circle of radius R the floor is what lies less than H above its lowest point, so
/// the switch stands at the angle whose cosine is (R - H)/R, whatever the step.
#[test]
fn wall_and_floor_change_at_the_angle_of_the_paper() {
    for radius in [4.0, 8.0, 20.0, 60.0] {
        let ball: f64 = LISTING.ball;
        let whole = radius + ball;
        let height = ball * ball / (whole * whole - ball * ball).sqrt() / 2.0 + LISTING.stock;
        let switch = ((radius - height) / radius).acos().to_degrees();
        let step = 0.25;
        let angles: Vec<f64> = (0..=336).map(|k| 85.0 - f64::from(k) * step).collect();
        let circle: Vec<Point> = angles
            .iter()
            .map(|angle| {
                let (sin, cos) = angle.to_radians().sin_cos();
                [radius * sin, 0.0, -radius * cos]
            })
            .collect();
        let (nc, _) = post(Some("feed-ahead.fil"), &cl_of(LISTING, &circle)).unwrap();
        let feeds: Vec<f64> = cuts(&nc).iter().map(|(_, feed)| *feed).collect();
        // The feed falls to less than a third at one point and nowhere else.
        let falls: Vec<usize> =
            (1..feeds.len()).filter(|k| feeds[*k] < feeds[k - 1] / 3.0).collect();
        let [fall] = falls[..] else { panic!("radius {radius}: {} changes", falls.len()) };
        // A chord has the angle between those of its ends.
        let middle = |cut: usize| (angles[cut] + angles[cut + 1]) / 2.0;
        let (wall, floor) = (middle(fall - 1), middle(fall));
        assert!(
            floor < switch && switch <= wall,
            "radius {radius}: the change lies between {wall} and {floor}, not at {switch}"
        );
    }
}

#[test]
fn the_feed_of_the_file_is_back_after_the_pass() {
    let cl = pass_cl().replace(
        "FEDCTL / OFF\nSEQNO / 1060\n",
        "RAPID\nGOTO / -15, 0, 5\nFEDCTL / OFF\nGOTO / -16, 0, -4.369\n",
    );
    let (nc, _) = post(Some("feed-ahead.fil"), &cl).unwrap();
    assert_eq!(cuts(&nc).last().map(|(point, feed)| (point[0], *feed)), Some((-16.0, 5.0)));
}

fn cutting() -> impl Strategy<Value = Cutting> {
    (1.5..12.0, 0.0..1.0, 200.0..8000.0, 1.0..20.0_f64).prop_map(|(ball, stock, speed, feed)| {
        // As many decimals as a CL file has.
        let [ball, stock, speed, feed] =
            [ball, stock, speed, feed].map(|value: f64| (value * 1000.0).round() / 1000.0);
        Cutting { ball, stock, speed, feed }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any tool on any path in space that bends a little at each point.
    #[test]
    fn every_pass_has_the_feed_of_the_formulas(
        cutting in cutting(),
        turns in prop::collection::vec((0.5..3.0_f64, 0.02..0.3_f64, -0.2..0.2_f64), 3..30),
    ) {
        let mut at = [40.0, -3.0, 5.0];
        let mut heading: f64 = -1.5;
        let mut path = vec![at];
        for (length, turn, aside) in turns {
            at = [
                at[0] - length * heading.cos(),
                at[1] + length * aside,
                at[2] + length * heading.sin(),
            ];
            heading += turn;
            path.push(at.map(|value: f64| (value * 10_000.0).round() / 10_000.0));
        }
        let cl = cl_of(cutting, &path);
        let limited = |feed: f64| feed.clamp(0.001, 9999.0);
        let expected = pass(cutting, &path, Floor::Formula);
        let (nc, _) = post(Some("feed-ahead.fil"), &cl).unwrap();
        for ((_, found), formula) in cuts(&nc).iter().zip(&expected) {
            let formula = limited(formula.feed);
            prop_assert!((found - formula).abs() <= 0.000_5 + formula * 1e-7, "F{found}, not {formula}");
        }
        prop_assert_eq!(cuts(&nc).len(), expected.len());
    }
}
