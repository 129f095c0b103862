//! What compiled code shares with evm.wasm.

/// What compiled code finds at entry, and leaves: addresses and sizes in bytes, and operands of calculations.
#[repr(C)]
#[derive(Default)]
pub struct State {
    /// The end of the stack; its first word, and the end of its room.
    pub stack: u32,
    pub bottom: u32,
    pub limit: u32,
    pub memory: u32,
    pub size: u32,
    pub data: u32,
    pub data_size: u32,
    pub pc: u32,
    pub gas: u64,
    /// 1 if the call has to run again in the interpreter.
    pub gave_up: u32,
    /// A bit for each position of the code: whether it is a JUMPDEST.
    pub jumps: u32,
    pub interpreter: u32,
    pub operands: [[u64; 4]; 3],
}

/// What compiled code does not calculate itself.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Calculation {
    Divide,
    DivideSigned,
    Remainder,
    RemainderSigned,
    AddMod,
    MulMod,
    ExtendSign,
    /// The word of the data of the call at a place; zeros follow the data.
    ReadData,
}
