//! Motions whose end the settings of the machine give or correct.

use super::ahead::Steps;
use super::walk::Walk;
use super::wanted::{Effect, Step, Wanted};

impl<C: Steps> Walk<'_, C> {
    /// A rapid to a position of the linear axes, mm. With rotary axes it is not followed.
    pub(super) fn go_to_machine(&mut self, cl_line: u32, to: [Option<f64>; 3], what: &str) {
        let mut pose = self.settings.forward.pose(&self.at);
        if self.settings.forward.has_rotary() {
            return self.unknown(cl_line, what, Effect::Path);
        }
        for (n, value) in to.into_iter().enumerate() {
            pose.tip[n] = value.unwrap_or(pose.tip[n]);
        }
        self.motion(&Step { line: cl_line, what: Wanted::Rapid(pose) });
    }

    /// An arc as the settings of the machine correct it; `None` where they leave it.
    pub(super) fn corrected(&mut self, step: &Step) -> Option<Step> {
        let before = self.corrected_end.take();
        let Wanted::Arc(arc, rate) = &step.what else { return None };
        let mut corrected = arc.from(before.filter(|[end, _]| *end == arc.start).map(|[_, at]| at));
        corrected.end.tip = self.settings.arc_end(&corrected, self.metric);
        self.corrected_end = Some([arc.end.tip, corrected.end.tip]);
        (corrected != *arc).then(|| Step { what: Wanted::Arc(corrected, *rate), ..step.clone() })
    }
}
