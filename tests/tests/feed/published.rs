//! The published form: R parameters and L400.

use filpost_tests::feed::{Floor, LISTING, Point, contact};
use filpost_tests::sinumerik::{self, Move};

use super::{pass_cl, points, post};

/// The program as printed; `...` stands in the print for the blocks between.
const PRINTED: &str = "\
N40 G54 S1000 M3
N50 R101=0.123 R102=5. R103=.25 R105=1000
...
N80 R1=15.622 R2=16.225 R3=4.365 R4=15.
N90 R5=2.942 R6=75.23 R7=2.845 R8=.75
N100 R51=14.25 R52=0.0 R53=-7.21
N101 L400
...
N960 R5=5.631 R6=74.552 R7=5.428 R8=1.5
N970 R51=-15. R52=0.0 R53=-4.369 L400
N980 R1=5.631 R2=74.552 R3=5.428 R4=1.5
N1060 G0 Z200
N1070 X0 Y0
N1080 M5
N1090 M2
%_N_L400_SPF
R9=R3+R7 R10=R4+R8 R11=ATAN2(R10,R9) R12=90-R6-R11 R13=SIN(R12) R14=(R1/(2*R13))
R15=R102/(R14+R102) R16=ASIN(R15) R17=TAN(R16) R18=((R102*R17)/2)+R103
R19=(R14-R18)/(R14) R20=ABS(90-ASIN(R19))
IF R6<R20 GOTOF MA2
R21=R105*sin(R6) R22=(0.18*R21)*(R101)*(LN(R14+R102)) R23=5 R24=R22*R23
N6 G1 X=R51 Y=R52 Z=R53 F=R24 GOTOF MA3
MA2: R21=R105*sin(R6) R22=(0.006*R21)*(R101)*(LN(R14+R102)) R23=5. R24=R22*R23
N7 G1 X=R51 Y=R52 Z=R53 F=R24
N8 MA3: M17
";

fn moves() -> (Vec<Point>, Vec<Move>) {
    let cl = pass_cl();
    let (nc, _) = post(Some("feed-l400.fil"), &cl).unwrap();
    let mut path = vec![[0.0; 3]];
    path.extend(points(&cl));
    (path, sinumerik::run(&nc).unwrap())
}

#[test]
fn the_printed_blocks_stand_word_for_word() {
    let (nc, _) = post(Some("feed-l400.fil"), &pass_cl()).unwrap();
    let parts: Vec<&str> = PRINTED.split("...\n").collect();
    assert!(nc.starts_with(parts[0]), "{nc}");
    let rest = &nc[parts[0].len()..];
    let (_, rest) = rest.split_once(parts[1]).expect("the blocks N80 to N101, one after the other");
    assert!(rest.ends_with(parts[2]), "{rest}");
}

/// Each call finds in its parameters the two moves and the end point, to the three
/// decimals of the print.
#[test]
fn parameters_are_the_moves_before_and_at_each_call() {
    let (path, moves) = moves();
    assert_eq!(moves.len(), 30);
    for (k, made) in moves.iter().enumerate() {
        let mut expected = Vec::new();
        for (first, ends) in [(1, &path[k..k + 2]), (5, &path[k + 1..k + 3])] {
            let [dx, dy, dz] = [0, 1, 2].map(|axis: usize| (ends[1][axis] - ends[0][axis]).abs());
            let level = dx.hypot(dy);
            let angle = dz.atan2(level).to_degrees();
            expected.extend((first..).zip([level.hypot(dz), angle, dz, level]));
        }
        expected.extend((51..).zip(path[k + 2]));
        expected.extend([(101, 5_f64.powf(-1.3)), (102, 5.0), (103, 0.25), (105, 1000.0)]);
        for (number, value) in expected {
            let found = made.called_with[&number];
            assert!((found - value).abs() < 0.000_501, "call {k}: R{number}={found}, not {value}");
        }
    }
}

/// Where L400 has a feed, it is that of the formulas for the circle of the last three
/// points, but for the 4 that the subprogram leaves out and for the decimals of the
/// parameters; where the path rises, R14 is negative and LN has no value.
#[test]
fn the_subprogram_gives_the_feed_of_the_formulas_on_the_way_down() {
    let (path, moves) = moves();
    let mut stops = 0;
    for (k, made) in moves.iter().enumerate() {
        let [a, b, c] = [path[k], path[k + 1], path[k + 2]];
        let turns_up = (b[0] - a[0]) * (c[2] - b[2]) - (b[2] - a[2]) * (c[0] - b[0]) < 0.0;
        let rises = c[2] > b[2];
        let expected = contact(LISTING, [a, b, c], b, c, Floor::Subprogram);
        match &made.done {
            Ok((point, feed)) => {
                assert!(!rises && turns_up && k > 0, "call {k} has a feed");
                assert!((0..3).all(|axis| (point[axis] - c[axis]).abs() < 0.000_501));
                let off = (feed - expected.feed) / expected.feed;
                assert!(off.abs() < 0.01, "call {k}: {feed}, not {}", expected.feed);
            }
            Err(alarm) => {
                assert!(rises || k == 0, "call {k} stops at {alarm}");
                stops += 1;
            }
        }
    }
    assert_eq!((stops, moves.len()), (16, 30));
}

/// The machine of the case is one of word addresses, of which the script warns.
const FAMILY: &str = "R101 TO R105 AND L400 ARE FOR A SINUMERIK 840D, CONTROL.FAMILY IS 0 HERE";

#[test]
fn the_feed_for_the_floor_is_that_of_the_print() {
    let cl = pass_cl().replace("FEDRAT / 5.000000", "FEDRAT / 8");
    let (_, warnings) = post(Some("feed-l400.fil"), &cl).unwrap();
    let said: Vec<&str> = warnings.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(said[..2], [FAMILY, "L400 AS PRINTED SETS 5 MM/MIN FOR THE FLOOR, NOT 8"]);
}

/// The script counts in its warning the calls at which the control stops: on the way up
/// and, at radii below half the height of the stock, on the way down.
#[test]
fn the_script_says_for_how_many_points_the_subprogram_has_no_feed() {
    let said = |cl: &str| -> (Vec<String>, usize) {
        let (nc, warnings) = post(Some("feed-l400.fil"), cl).unwrap();
        let stops = sinumerik::run(&nc).unwrap().iter().filter(|made| made.done.is_err()).count();
        (warnings.into_iter().map(|warning| warning.message).collect(), stops)
    };
    let texts = |stops: usize| {
        let no_feed = format!("L400 AS PRINTED HAS NO FEED FOR {stops} OF 30 POINTS");
        vec![FAMILY.to_string(), no_feed]
    };
    assert_eq!(said(&pass_cl()), (texts(16), 16));
    let mut on_the_way_down = Vec::new();
    for radius in [0.5, 1.0, 1.4, 2.0, 3.0, 9.0] {
        let mut cl = String::from(
            "UNITS / MM\nFROM / 40, 0, 9\nSPINDL / RPM, 1000\nFEDCTL / ON, RADIUS, 5, STOCK, 0.25\nRAPID\n",
        );
        for k in 0..=30 {
            let (sin, cos) = (f64::from(k) * 5.5 - 85.0).to_radians().sin_cos();
            cl += &format!("GOTO / {:.4}, 0, {:.4}\n", -radius * sin, -radius * cos);
        }
        cl += "FEDCTL / OFF\nRAPID\nGOTO / 0, 0, 90\nFINI\n";
        let (warnings, stops) = said(&cl);
        assert_eq!(warnings, texts(stops), "radius {radius}");
        on_the_way_down.push(stops > 16);
    }
    assert_eq!(on_the_way_down, [true, true, true, false, false, false]);
}
