//! Directions of the tool where the rotary axes stand.

use nalgebra::Vector3;

use super::{AxisChain, Carries, Rotary};

impl AxisChain {
    /// The tool axis in the part where the rotary axes stand at these positions, degrees.
    pub fn axis_at(&self, angles: [f64; 2]) -> Vector3<f64> {
        self.turned_by(angles, |_| true)
    }

    /// The direction of the tool in the machine, away from its tip, where the rotary axes stand at
    /// these positions, degrees: heads turn it, tables don't.
    pub fn tool_at(&self, angles: [f64; 2]) -> Vector3<f64> {
        self.turned_by(angles, |rotary| rotary.carries == Carries::Head)
    }

    /// The tool turned by some of the rotary axes.
    fn turned_by(&self, angles: [f64; 2], turns: impl Fn(&Rotary) -> bool) -> Vector3<f64> {
        let axes = self.rotaries.iter().zip(angles).rev();
        axes.fold(self.tool.into_inner(), |tool, (rotary, at)| match rotary {
            Some(rotary) if turns(rotary) => rotary.turned(tool, at),
            _ => tool,
        })
    }
}
