//! MODE: what X and the main spindle are from here on.

use super::ahead::Steps;
use super::verifier::Verifier;

impl<C: Steps> Verifier<'_, C> {
    /// X on the tape is another multiple of its position from here on, which the
    /// program does not say.
    pub(super) fn scale_x(&mut self, scale: f64) {
        let change = std::mem::replace(&mut self.limits.x_scale, scale) / scale;
        self.nc.scale_x(self.next, change);
    }

    /// Asks for the code of the main spindle, as an axis or as a spindle, where MODE has
    /// changed what it is.
    pub(super) fn ask_spindle_mode(&mut self, cl_line: u32, mills: bool) {
        if self.expected.changes_spindle(mills) {
            let code = self.settings.spindle_mode_code(mills);
            self.ask_auxiliary(cl_line, code);
        }
    }

    /// Behind a tool change the program may say once more that the main spindle is the axis C, so
    /// that it can be begun there.
    pub(super) fn allow_spindle_mode_again(&mut self) {
        if let Some(code) = self.settings.spindle_mode_code(true).filter(|_| self.expected.mills())
        {
            let lines = self.lines_here();
            self.auxiliaries.allow(code, lines);
        }
    }
}
