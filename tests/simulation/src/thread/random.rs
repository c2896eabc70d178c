//! Random threads, in thousandths as a CL file has them.

use proptest::prelude::*;

use super::Thread;

/// Numbers as a CL file has them.
fn thousandths(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

prop_compose! {
    /// Threads that a machinist could ask for.
    pub fn threads()(
        nose in 0.3..4.0_f64,
        wider in prop_oneof![Just(0.0), 0.0..3.0_f64],
        shift in 0.2..1.0_f64,
        angle in prop::sample::select(vec![0.0, 7.0, 29.0, 30.0, 40.0, 55.0, 60.0]),
        // Where the flank towards the end lies: half of the angle, or another share.
        share in prop_oneof![2 => Just(0.5), 1 => 0.0..1.0_f64],
        slimmer in prop_oneof![3 => Just(0.0), 1 => 0.0..5.0_f64],
        layers in prop::collection::vec(0.2..3.0_f64, 1..5),
        first in 0.35..0.9_f64,
        crest_width in 0.0..5.0_f64,
        starts in 1..4_u32,
        finish in 0..3_u32,
        internal: bool,
        backwards: bool,
    ) -> Thread {
        let layers: Vec<f64> = layers.into_iter().map(thousandths).collect();
        let tool_angle = thousandths((angle - slimmer).max(0.0));
        let nose = thousandths(nose);
        let share = if angle == 0.0 { 0.5 } else { share };
        let (end_flank, end_edge) = if share == 0.5 {
            (angle / 2.0, tool_angle / 2.0)
        } else {
            let flank = thousandths(angle * share);
            // Each edge is slimmer by its share.
            let edge = flank - (angle - tool_angle) * flank / angle;
            (flank, thousandths(edge.clamp(0.0, tool_angle)))
        };
        let mut thread = Thread {
            crest: thousandths(layers.iter().sum::<f64>() + 8.5),
            start: 6.123,
            end: if backwards { 60.0 } else { -50.25 },
            pitch: 0.0,
            starts,
            first: thousandths(first),
            root: thousandths(nose + wider),
            angle,
            end_flank,
            nose,
            tool_angle,
            end_edge,
            shift: thousandths(nose * shift),
            clearance: 1.5,
            finish,
            internal,
            tolerance: 0.0,
            layers,
        };
        thread.pitch = thousandths(thread.reach(0.0).iter().sum::<f64>() + crest_width) + 0.001;
        // No layer has more than 99 shifts.
        let least = thousandths(thread.span(thread.layers[0]) / 90.0) + 0.001;
        thread.shift = thread.shift.max(least).min(nose);
        let highest = thread.layers.iter().copied().fold(0.0, f64::max);
        let slimmer = (0..2).map(|side| {
            thread.flanks()[side].to_radians().tan() - thread.edges()[side]
        });
        let stair = highest * slimmer.fold(0.0, f64::max);
        thread.tolerance = thousandths(stair) + 0.001;
        thread
    }
}

/// A length of a CL file, most of them sound.
fn length(most: f64) -> impl Strategy<Value = f64> {
    prop_oneof![8 => (0.0..most).prop_map(thousandths), 1 => Just(0.0), 1 => Just(-most)]
}

prop_compose! {
    /// Threads of which many can't be cut.
    pub fn odd_threads()(
        mut thread in threads(),
        nose in length(4.0),
        root in length(6.0),
        shift in length(2.0),
        first in length(1.0),
        pitch in length(30.0),
        tool_angle in length(60.0),
        tolerance in length(0.5),
        height in length(5.0),
        which in 0..256_u32,
    ) -> Thread {
        let fields = [
            (&mut thread.nose, nose),
            (&mut thread.root, root),
            (&mut thread.shift, shift),
            (&mut thread.first, first),
            (&mut thread.pitch, pitch),
            (&mut thread.tool_angle, tool_angle),
            (&mut thread.tolerance, tolerance),
            (&mut thread.layers[0], height),
        ];
        for (bit, (field, value)) in fields.into_iter().enumerate() {
            if which >> bit & 1 == 1 {
                *field = value;
            }
        }
        thread
    }
}
