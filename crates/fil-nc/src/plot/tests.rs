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
            start: index,
            end: index + 2,
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
