//! The page of the docs: its times and its picture are computed here.

use filpost_tests::feed::{Contact, Floor, LISTING, Point, length, minutes, pass};
use filpost_tests::picture::{Pen, Picture};
use filpost_tests::root;

use super::{cuts, pass_cl, points, post, read};

const GROUND: Pen = Pen::full("#888888", 1.0);
const WALL: &str = "#1f6fb2";
const FLOOR: &str = "#c8401f";

/// The listing's constant feed, and what the paper says both passes took, minutes.
const CONSTANT: f64 = 6.0;
const PAPER: [f64; 2] = [12.0, 1.2];

#[test]
fn the_page_gives_the_times_of_the_pass() {
    let cl = pass_cl();
    let points = points(&cl);
    let (nc, _) = post(Some("feed-ahead.fil"), &cl).unwrap();
    let ours = minutes(&points, cuts(&nc).iter().map(|(_, feed)| *feed));
    let (nc, _) = post(None, &without_feed_control(&cl)).unwrap();
    let constant = minutes(&points, cuts(&nc).iter().map(|(_, feed)| *feed));
    let as_subprogram = pass(LISTING, &points, Floor::Subprogram);
    let as_subprogram = minutes(&points, as_subprogram.iter().map(|contact| contact.feed));
    // The paper's first time is that of the length at the constant feed.
    assert!((constant - PAPER[0]).abs() < 0.01, "{constant}");
    assert!((constant - length(&points) / CONSTANT).abs() < 1e-9);
    // Its second is near that of the floor without the 4.
    assert!((as_subprogram - PAPER[1]).abs() < 0.2 && ours < as_subprogram);
    let page = read("docs/papers/feed-control.md");
    for time in [constant, ours, as_subprogram] {
        let shown = format!("{time:.2} min");
        assert!(page.contains(&shown), "docs/papers/feed-control.md does not say {shown}");
    }
}

/// What the page says of the cuts on the floor: how many, how long, and their part of the time.
#[test]
fn the_page_gives_the_part_of_the_floor() {
    let points = points(&pass_cl());
    let part = |floor: Floor| {
        let contacts = pass(LISTING, &points, floor);
        let (mut count, mut on_floor, mut time, mut all) = (0, 0.0, 0.0, 0.0);
        for (ends, contact) in points.windows(2).zip(&contacts) {
            let way = length(ends);
            all += way / contact.feed;
            if contact.floor {
                count += 1;
                on_floor += way;
                time += way / contact.feed;
            }
        }
        (contacts.len(), count, on_floor, time / all)
    };
    let (cuts, count, on_floor, share) = part(Floor::Formula);
    assert_eq!((cuts, count), (30, 3));
    let said = format!("three of the 30 cuts, {on_floor:.1} mm of {:.0},", length(&points));
    let page = read("docs/papers/feed-control.md");
    assert!(page.contains(&said), "docs/papers/feed-control.md does not say {said}");
    assert!((share - 2.0 / 3.0).abs() < 0.02, "two thirds: {share}");
    let (.., share) = part(Floor::Subprogram);
    assert!(share > 0.8 && share < 0.9, "more than four fifths: {share}");
}

/// The same pass at the listing's constant feed.
fn without_feed_control(cl: &str) -> String {
    let lines = cl.lines().filter(|line| !line.starts_with("FEDCTL"));
    let lines: Vec<&str> = lines.collect();
    lines.join("\n").replace("FEDRAT / 5.0", "FEDRAT / 6.0")
}

/// A chart over the length of the pass: where its lower left corner lies, how wide
/// and high it is, what its axis ends with.
struct Chart {
    corner: Point2,
    size: Point2,
    length: f64,
    top: f64,
}

type Point2 = [f64; 2];

impl Chart {
    fn place(&self, along: f64, value: f64) -> Point2 {
        let [x, y] = self.corner;
        [x + along / self.length * self.size[0], y + value / self.top * self.size[1]]
    }

    fn frame(&self, picture: &mut Picture, title: &str, marks: &[(f64, &str)]) {
        let [x, y] = self.corner;
        let [width, height] = self.size;
        picture.line(&[[x, y + height], [x, y], [x + width, y]], GROUND);
        picture.text([x + width / 2.0, y + height + 2.0], title);
        for (value, name) in marks {
            let [x, y] = self.place(0.0, *value);
            picture.line(&[[x - 0.5, y], [x, y]], GROUND);
            picture.text([x - 3.0, y - 0.4], name);
        }
    }
}

/// Ends of the moves along the pass, mm from its start.
fn along(points: &[Point]) -> Vec<f64> {
    (1..=points.len()).map(|count| length(&points[..count])).collect()
}

fn colour(contact: &Contact) -> &'static str {
    if contact.floor { FLOOR } else { WALL }
}

/// What the ball cuts on its way: lines a radius from the moves, and where the path
/// turns up, arcs round its points.
fn swept(points: &[Point]) -> Vec<Point2> {
    let directions: Vec<f64> = points
        .windows(2)
        .map(|ends| (ends[1][2] - ends[0][2]).atan2(ends[1][0] - ends[0][0]))
        .collect();
    let touched = |point: &Point, direction: f64| {
        let angle = direction + std::f64::consts::FRAC_PI_2;
        let [x, z] = [point[0], point[2] + LISTING.ball];
        [x + LISTING.ball * angle.cos(), z + LISTING.ball * angle.sin()]
    };
    let mut outline = Vec::new();
    for (cut, direction) in directions.iter().enumerate() {
        let before = directions[cut.saturating_sub(1)];
        // The pass goes to -X: directions grow less from point to point of a valley.
        let turn = (direction - before).sin().asin();
        for step in 0..=8 {
            outline.push(touched(&points[cut], before + turn * f64::from(step) / 8.0));
        }
    }
    if let (Some(last), Some(direction)) = (points.last(), directions.last()) {
        outline.push(touched(last, *direction));
    }
    outline
}

/// The section of the groove with the ball on the wall and on the floor.
fn profile(picture: &mut Picture, points: &[Point], contacts: &[Contact]) {
    let center = |point: &Point| [point[0], point[2] + LISTING.ball];
    for (ends, contact) in points.windows(2).zip(contacts) {
        picture.line(&[center(&ends[0]), center(&ends[1])], Pen::full(colour(contact), 3.0));
    }
    picture.line(&swept(points), Pen::full("black", 1.5));
    for index in [3, 15] {
        picture.circle(center(&points[index]), LISTING.ball, GROUND);
    }
    for (at, name) in [
        ([0.0, 6.0], "section of the groove"),
        ([0.0, 0.0], "path of the ball's"),
        ([0.0, -2.0], "center: blue on"),
        ([0.0, -4.0], "the wall, red"),
        ([0.0, -6.0], "on the floor"),
    ] {
        picture.text(at, name);
    }
}

#[test]
fn the_picture_shows_profile_angle_and_feed() {
    let cl = pass_cl();
    let points = points(&cl);
    let contacts = pass(LISTING, &points, Floor::Formula);
    let along = along(&points);
    let total = along[along.len() - 1];
    let mut picture = Picture::default();
    profile(&mut picture, &points, &contacts);
    let chart =
        |y: f64, top: f64| Chart { corner: [32.0, y], size: [44.0, 14.0], length: total, top };

    let angles = chart(-10.0, 90.0);
    angles.frame(
        &mut picture,
        "angle of each move to the level",
        &[(0.0, "0°"), (45.0, "45°"), (90.0, "90°")],
    );
    let middle = |cut: usize| (along[cut] + along[cut + 1]) / 2.0;
    let limit = |contact: &Contact| contact.limit.to_degrees().min(90.0);
    let dashed: Vec<Point2> = contacts
        .iter()
        .enumerate()
        .map(|(cut, contact)| angles.place(middle(cut), limit(contact)))
        .collect();
    picture.line(&dashed, Pen::dashed("black", 1.0));

    // The feed from 1 to 1000 mm/min, each ten times the last.
    let feeds = chart(-34.0, 3.0);
    feeds.frame(
        &mut picture,
        "feed of each block, mm/min",
        &[(0.0, "1"), (1.0, "10"), (2.0, "100"), (3.0, "1000")],
    );
    let constant = CONSTANT.log10();
    picture.line(
        &[feeds.place(0.0, constant), feeds.place(total, constant)],
        Pen::dashed("black", 1.0),
    );
    for (cut, contact) in contacts.iter().enumerate() {
        let pen = Pen::full(colour(contact), 3.0);
        for (chart, value) in
            [(&angles, contact.angle.to_degrees()), (&feeds, contact.feed.log10())]
        {
            picture
                .line(&[chart.place(along[cut], value), chart.place(along[cut + 1], value)], pen);
        }
    }
    for (at, name) in [
        (angles.place(58.0, 40.0), "floor: below"),
        (angles.place(58.0, 27.0), "the dashes"),
        (feeds.place(56.0, constant - 0.45), "dashes: constant, F6"),
        (feeds.place(total / 2.0, -0.45), "along the pass, 72 mm"),
    ] {
        picture.text(at, name);
    }
    picture.check(&root().join("docs/papers/feed-control.svg"));
}
