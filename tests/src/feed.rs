//! Feed control for ball-end milling by the formulas of A. M. Kozlov and
//! G. E. Malyutin (2018), evaluated from the paper alone. Numbers in brackets are
//! those of its formulas; angles are radians here.

/// A point of the path of the ball, mm.
pub type Point = [f64; 3];

/// Tool, stock and speed of a pass.
#[derive(Clone, Copy, Debug)]
pub struct Cutting {
    /// Radius of the ball, mm.
    pub ball: f64,
    /// Stock the operation before has left, mm.
    pub stock: f64,
    /// Revolutions a minute.
    pub speed: f64,
    /// The feed set for the floor, mm/min.
    pub feed: f64,
}

/// The case of the paper's listing.
pub const LISTING: Cutting = Cutting { ball: 5.0, stock: 0.25, speed: 1000.0, feed: 5.0 };

/// The floor's part of the correction that does not depend on the speed: 4 in
/// formula (23), left out in the printed subprogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Floor {
    /// As formula (23).
    Formula,
    /// As the subprogram L400.
    Subprogram,
}

/// What the formulas say of one move.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Radius of the path, mm (24).
    pub radius: f64,
    /// Height of the stock left on the floor, mm (1).
    pub height: f64,
    /// Angle of the move to the level (30).
    pub angle: f64,
    /// Below this angle the ball cuts the floor (32).
    pub limit: f64,
    /// True on the floor.
    pub floor: bool,
    /// The feed, mm/min (21).
    pub feed: f64,
}

fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// Radius of the circle through three points (24), with the area from the three
/// sides alone.
pub fn radius([a, b, c]: [Point; 3]) -> f64 {
    let mut sides = [distance(a, b), distance(b, c), distance(a, c)];
    sides.sort_by(f64::total_cmp);
    let [z, y, x] = sides;
    // Heron's formula in the order that keeps thin triangles exact.
    let area4 = ((x + (y + z)) * (z - (x - y)) * (z + (x - y)) * (x + (y - z))).sqrt();
    x * y * z / area4
}

/// The feed of a move, on the circle through three points.
pub fn contact(
    cutting: Cutting,
    circle: [Point; 3],
    from: Point,
    to: Point,
    law: Floor,
) -> Contact {
    let radius = radius(circle);
    // tan(asin(x)) by the sides of the triangle.
    let ratio = cutting.ball / (radius + cutting.ball);
    let height = cutting.ball * ratio / (1.0 - ratio * ratio).sqrt() / 2.0 + cutting.stock;
    // 90 - asin(x) is acos(x); a stock higher than the circle is everywhere.
    let limit = ((radius - height) / radius).max(-1.0).acos();
    let level = (to[0] - from[0]).hypot(to[1] - from[1]);
    let angle = (to[2] - from[2]).abs().atan2(level);
    let floor = height > 2.0 * radius || angle < limit;
    let turns = cutting.speed * angle.sin();
    let share = match (floor, law) {
        (false, _) => 0.18 * turns,
        (true, Floor::Formula) => 0.006 * turns + 4.0,
        (true, Floor::Subprogram) => 0.006 * turns,
    };
    let factor = share * (radius + cutting.ball).ln() / cutting.ball.powf(1.3);
    Contact { radius, height, angle, limit, floor, feed: cutting.feed * factor }
}

/// The moves of a pass: each on the circle of its two points and the next, the
/// last on that of the last three.
pub fn pass(cutting: Cutting, points: &[Point], law: Floor) -> Vec<Contact> {
    (1..points.len())
        .map(|k| {
            let last = (k + 1).min(points.len() - 1);
            let circle = [points[last - 2], points[last - 1], points[last]];
            contact(cutting, circle, points[k - 1], points[k], law)
        })
        .collect()
}

/// Length of a pass, mm.
pub fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|ends| distance(ends[0], ends[1])).sum()
}

/// Time of a pass, minutes: the length of each move by its feed.
pub fn minutes(points: &[Point], feeds: impl IntoIterator<Item = f64>) -> f64 {
    let moves = points.windows(2).map(|ends| distance(ends[0], ends[1]));
    moves.zip(feeds).map(|(length, feed)| length / feed).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_is_that_of_the_circle() {
        let on = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [7.0 + 20.0 * cos, -3.0, 11.0 + 20.0 * sin]
        };
        for step in [0.1, 1.0, 30.0, 100.0] {
            let found = radius([on(200.0), on(200.0 + step), on(200.0 + 2.0 * step)]);
            assert!((found - 20.0).abs() < 1e-6, "{found} at {step} degrees");
        }
    }

    #[test]
    fn the_floor_reaches_up_to_the_height_of_its_stock() {
        // Where the path has risen by H above its lowest point: R - R cos(limit) = H.
        let circle = [[-20.0, 0.0, 0.0], [0.0, 0.0, -20.0], [20.0, 0.0, 0.0]];
        let contact = contact(LISTING, circle, [0.0, 0.0, -20.0], [20.0, 0.0, 0.0], Floor::Formula);
        let risen = contact.radius * (1.0 - contact.limit.cos());
        assert!((risen - contact.height).abs() < 1e-9);
        // 5 tan(asin(5 / 25)) / 2 + 0.25
        assert!((contact.height - 0.760_310).abs() < 1e-6, "{}", contact.height);
    }
}
