use super::simplify::Lines;
use super::*;

fn square(count: usize) -> Trace {
    let points: Vec<Point> = (0..=count)
        .map(|index| {
            let share = index as f64 / count as f64;
            [100.0 * share, 0.0, 0.0]
        })
        .collect();
    let pieces = (0..count)
        .map(|index| Piece {
            stroke: Stroke::Feed,
            line: index as u32 + 1,
            start: index as u32,
            end: index as u32 + 2,
        })
        .collect();
    Trace { points, pieces, ..Trace::default() }
}

#[test]
fn a_straight_line_of_many_motions_is_one_line_on_paper() {
    let mut lines = Lines::default();
    for step in 0..10_000 {
        lines.add([[step, 2 * step], [step + 1, 2 * step + 2]]);
    }
    lines.finish();
    let dots: usize = lines.lines.iter().map(Vec::len).sum();
    assert_eq!(dots, 2);
    assert_eq!(lines.lines[0].first(), Some(&[0, 0]));
    assert_eq!(lines.lines.last().and_then(|line| line.last()), Some(&[10_000, 20_000]));
}

#[test]
fn a_line_drawn_twice_is_drawn_once() {
    let mut lines = Lines::default();
    for _ in 0..50 {
        lines.add([[0, 0], [500, 0]]);
        lines.add([[500, 0], [500, 500]]);
        lines.add([[500, 500], [500, 0]]);
        lines.add([[500, 0], [0, 0]]);
    }
    lines.finish();
    let stretches: usize = lines.lines.iter().map(|line| line.len() - 1).sum();
    assert_eq!(stretches, 2);
}

#[test]
fn corners_are_kept() {
    let mut lines = Lines::default();
    lines.add([[0, 0], [100, 0], [100, 100], [0, 100]]);
    lines.finish();
    assert_eq!(lines.lines, [[[0, 0], [100, 0], [100, 100], [0, 100]]]);
}

#[test]
fn a_picture_does_not_grow_with_the_motions() {
    let picture = |count| {
        let drawing = Drawing { path: square(count), ..Drawing::default() };
        svg(&drawing, &View::ALL)
    };
    let (few, many) = (picture(10), picture(200_000));
    assert!(many.len() < few.len() + 4_000, "{} {}", few.len(), many.len());
}

#[test]
fn a_title_is_text_in_both_pictures() {
    let drawing = Drawing { title: "<b>&{{data}}".into(), ..Drawing::default() };
    assert!(svg(&drawing, &[View::Xy]).contains("&lt;b&gt;&amp;{{data}}"));
    let page = html(&drawing);
    assert!(page.contains("<title>&lt;b&gt;&amp;{{data}}</title>"));
    assert!(!page.contains("http://") && !page.contains("https://"));
}

/// Boxes of the texts of a picture, by their letters.
fn boxes(picture: &str) -> Vec<(String, [f64; 4])> {
    let texts = picture.split("<text ").skip(1);
    let of = |tag: &str, key: &str| -> Option<f64> {
        tag.split_once(&format!("{key}=\""))?.1.split('"').next()?.parse().ok()
    };
    let one = |text: &str| {
        let (tag, rest) = text.split_once('>').unwrap();
        let label = rest.split('<').next().unwrap().to_string();
        let size = of(tag, "font-size").unwrap_or(13.0);
        // Letters of common fonts are narrower than this.
        let width = label.chars().count() as f64 * size * 0.58;
        let [x, y] = [of(tag, "x").unwrap(), of(tag, " y").unwrap()];
        (label, [x, y - 0.75 * size, x + width, y + 0.2 * size])
    };
    texts.map(one).collect()
}

/// Many tools at many places close to one another.
fn crowded(count: u32) -> Drawing<'static> {
    let mut path = square(100);
    path.changes = (0..count)
        .map(|tool| Change {
            at: [f64::from(tool % 17) * 1.7, f64::from(tool % 5) * 2.0, f64::from(tool % 3)],
            tool: tool + 1,
            line: 1,
            from: 0,
        })
        .collect();
    path.axes = vec![(0, [0.0, 0.6, 0.8])];
    // The box around the path holds the changes.
    path.points.extend([[0.0, -20.0, -20.0], [0.0, 20.0, 20.0]]);
    let under = Some(square(10));
    Drawing { title: "a".repeat(300), path, under, under_name: "CL file", ..Drawing::default() }
}

#[test]
fn no_label_lies_on_another_one_or_beside_the_picture() {
    for (count, views) in
        [(3, &View::ALL[..]), (40, &View::ALL), (300, &[View::Xy]), (40, &[View::Isometric])]
    {
        let picture = svg(&crowded(count), views);
        let boxes = boxes(&picture);
        let tools = boxes.iter().filter(|(label, _)| label.starts_with('T'));
        let told: usize = tools.map(|(label, _)| label.matches('T').count()).sum();
        assert!(told >= 3 * views.len(), "{told} tools of {count}");
        let width: f64 =
            picture.split_once("width=\"").unwrap().1.split('"').next().unwrap().parse().unwrap();
        for (at, (label, one)) in boxes.iter().enumerate() {
            assert!(one[0] >= 0.0 && one[2] <= width, "{label} leaves the picture: {one:?}");
            for (other, two) in &boxes[at + 1..] {
                let apart =
                    one[2] < two[0] || one[0] > two[2] || one[3] < two[1] || one[1] > two[3];
                assert!(apart, "{label} {one:?} lies on {other} {two:?}");
            }
        }
    }
}

#[test]
fn live_tools_of_a_lathe_lie_as_the_cl_file_says() {
    let trace = |axes: &[(usize, Point)]| Trace { axes: axes.to_vec(), ..square(6) };
    let mut drawing = Drawing { path: square(6), lathe: true, ..Drawing::default() };
    drawing.under = Some(trace(&[(2, [0.0, 1.0, 0.0]), (4, [1.0, 0.0, 0.0])]));
    drawing.path.points[6][1] = 5.0;
    drawing.take_tool_axes();
    let none = [0.0; 3];
    assert_eq!(
        drawing.path.axes,
        [(0, none), (2, [0.0, 1.0, 0.0]), (4, [1.0, 0.0, 0.0]), (5, none)]
    );
    // Tools that lie along Z say nothing, and a mill has its axes from the machine.
    drawing.under = Some(trace(&[]));
    drawing.take_tool_axes();
    assert!(drawing.path.axes.is_empty());
    let mut mill = Drawing { path: square(6), ..Drawing::default() };
    mill.under = Some(trace(&[(2, [0.0, 1.0, 0.0])]));
    mill.take_tool_axes();
    assert!(mill.path.axes.is_empty());
}

#[test]
fn tools_have_the_shape_that_cutter_gives_before_or_after_their_change() {
    let cl = "UNITS / INCHES\nCUTTER / 2, 0, 1, 0.6, 31, 0, 5\nLOADTL / 3\nGOTO / 1, 2, 3\n\
              LOADTL / 4\nCUTTER / 1, 0.9\nGOTO / 4, 2, 3\nLOADTL / 5\nGOTO / 1, 1, 1\nFINI\n";
    let reader = fil_cl::Reader::new(cl.as_bytes(), "part.ncl", Default::default());
    let tools = cl_tools(reader, None).expect("the file is right");
    let drill =
        ToolShape { number: 3, diameter: 50.8, corner: 0.0, bottom: 31.0, length: Some(127.0) };
    // A corner is no larger than half the diameter.
    let ball = ToolShape { number: 4, diameter: 25.4, corner: 12.7, bottom: 0.0, length: None };
    assert_eq!(tools, [drill, ball]);
}

#[test]
fn times_count_rapids_feeds_and_surface_speeds() {
    let force = |from, feed, speed| InForce {
        from,
        tool: 1,
        feed: Some(feed),
        speed: Some(speed),
        speed_limit: Some(1000.0),
        spindle: crate::motion::Spindle::Clockwise,
        fixture: None,
    };
    let mut trace = square(4);
    trace.pieces[0].stroke = Stroke::Rapid;
    trace.in_force = vec![
        force(0, Rate::PerMinute(50.0), Speed::Turns(1.0)),
        force(2, Rate::PerTurn(0.5), Speed::Surface(100.0)),
    ];
    let ends = time::ends(&trace);
    // 25 mm each: at 10 m/min; at 50 mm/min; 0.5 mm a turn at 100 m/min on a radius of 62.5 mm, and
    // on one of 87.5 mm.
    let turns = |radius: f64| 100_000.0 / (2.0 * std::f64::consts::PI * radius);
    let times = [0.15, 30.0, 1500.0 / (0.5 * turns(62.5)), 1500.0 / (0.5 * turns(87.5))];
    let mut sum = 0.0;
    for (end, time) in ends.iter().zip(times) {
        sum += time;
        assert!((end - sum).abs() < 1e-9, "{ends:?} {times:?}");
    }
}
