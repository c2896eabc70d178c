//! The bytecode: what the compiler writes and the machine runs.
//!
//! All variables, constants and temporaries live in one register file; a
//! register is named by a `u16`, so no access needs a check.

/// A register.
pub type Reg = u16;
/// A position within the code of a [`Chunk`](crate::module::Chunk).
pub type Target = u16;

/// One operation, 8 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// `dst = src`
    Move { dst: Reg, src: Reg },
    /// `dst = -src`
    Neg { dst: Reg, src: Reg },
    /// `dst = a + b`
    Add { dst: Reg, a: Reg, b: Reg },
    /// `dst = a - b`
    Sub { dst: Reg, a: Reg, b: Reg },
    /// `dst = a * b`
    Mul { dst: Reg, a: Reg, b: Reg },
    /// `dst = dst + a * b`, rounded after each of both
    AddProduct { dst: Reg, a: Reg, b: Reg },
    /// `dst = a / b`
    Div { dst: Reg, a: Reg, b: Reg },
    /// `dst = a ** b`
    Pow { dst: Reg, a: Reg, b: Reg },
    /// Goes on at `to`.
    Jump { to: Target },
    /// Goes on at an earlier `to`; costs fuel.
    JumpBack { to: Target },
    /// Goes on at a later `to` when `a` equals `b`.
    JumpEq { a: Reg, b: Reg, to: Target },
    /// Goes on at a later `to` when `a` differs from `b`.
    JumpNe { a: Reg, b: Reg, to: Target },
    /// Goes on at a later `to` when `a < b`.
    JumpLt { a: Reg, b: Reg, to: Target },
    /// Goes on at a later `to` when `a <= b`.
    JumpLe { a: Reg, b: Reg, to: Target },
    /// Goes on at a later `to` when `a` is 1; 0 goes on here, all else is an error.
    JumpTrue { a: Reg, to: Target },
    /// Goes on at a later `to` when `a` is 0; 1 goes on here, all else is an error.
    JumpFalse { a: Reg, to: Target },
    /// Starts a DO: `base` holds the last value, `base + 1` the step.
    DoEnter { var: Reg, base: Reg, exit: Target },
    /// Steps a DO and goes back to `body` while the last value is not passed.
    DoNext { var: Reg, base: Reg, body: Target },
    /// `dst = array(index)`
    Load { dst: Reg, array: u16, index: Reg },
    /// `array(index) = src`
    Store { array: u16, index: Reg, src: Reg },
    /// `dst = function(base, base + 1, …)`, a built-in function of numbers.
    Function { dst: Reg, function: u16, base: Reg },
    /// `dst = function(base, base + 1, …)`, a function of the embedding program.
    HostFunction { dst: Reg, function: u16, base: Reg },
    /// A call on texts, files or the clock, of [`Module::calls`](crate::Module).
    Library { dst: Reg, call: u16 },
    /// `dst = TEXT/base,…` of `count` values.
    TextJoin { dst: Reg, base: Reg, count: u16 },
    /// `dst = POSTF(7,n)` with a constant `n`.
    RecordWord { dst: Reg, n: u16 },
    /// `dst = POSTF(…)`, the operation of that index, arguments from `base`.
    Postf { dst: Reg, op: u16, base: Reg },
    /// `dst = POSTF(base,…)` with a computed number; `count` arguments with the number.
    PostfDynamic { dst: Reg, base: Reg, count: u16 },
    /// `dst = COUPLF(word,default)`; `default` is a register.
    Couplet { dst: Reg, word: u16, default: Reg },
    /// `dst = COUPLF(word)`; a missing word is an error.
    CoupletOrFail { dst: Reg, word: u16 },
    /// `dst = HASF(word)`
    HasWord { dst: Reg, word: u16 },
    /// `dst = LASTF(letter)`
    LastWritten { dst: Reg, letter: Reg },
    /// `dst = COMF('name')`; `name` is a register.
    NamedCommon { dst: Reg, name: Reg },
    /// `dst = OPTIONF('name')`; `name` is a register.
    PostOption { dst: Reg, name: Reg },
    /// `dst = NEXTF(word)`
    NextMotion { dst: Reg, word: u16 },
    /// `dst = PREVF(word)`
    PreviousMotion { dst: Reg, word: u16 },
    /// `dst = TOOLF(DIAMTR)`
    ToolDiameter { dst: Reg },
    /// `dst = TOOLF(NEXT)`
    NextTool { dst: Reg },
    /// `dst = PROGF(word)`, `TLISTF(index,word)` or `OPERF(index,word)`; `what` holds the
    /// function and the number of the word.
    Totals { dst: Reg, what: u16, index: Reg },
    /// Sends the post word of that template.
    Post { template: u16 },
    /// Runs a macro; its parameters are set already.
    Call { macro_id: u16 },
    /// Ends a macro, a section or the global area.
    Return,
    /// The statement of this operation runs next. This and the operations below exist only
    /// in a debug build of the bytecode.
    Statement,
    /// The global area, a section or a macro begins.
    Enter,
    /// It ends.
    Leave,
    /// An outcome of a condition, by its number in [`Module::branches`](crate::Module).
    Branch { number: u16 },
}

#[cfg(test)]
mod tests {
    use super::Op;

    #[test]
    fn an_operation_is_eight_bytes() {
        assert_eq!(size_of::<Op>(), 8);
    }
}
