//! Frames in compiled code: what a module of `compile` finds at entry, and the functions that it calls.

use revm::{
    interpreter::{Interpreter, interpreter::EthInterpreter, interpreter_types::Jumps},
    primitives::U256,
};
use shackled_compile::{Calculation, State};

/// A contract with a module: its function `run`, by its place in the table of functions; whether it can be entered, by
/// position.
pub struct Compiled {
    run: usize,
    entries: Vec<bool>,
}

/// The call needs the interpreter from its start: close to the end of the gas, beyond 2^31, for a jump to no JUMPDEST.
pub struct GaveUp;

impl Compiled {
    pub fn new(run: usize, code: &[u8]) -> Self {
        Self { run, entries: shackled_compile::entries(code) }
    }

    /// Runs a frame until the first instruction that is left to the interpreter, if it can be entered where it is.
    pub fn run(&self, interpreter: &mut Interpreter<EthInterpreter>) -> Result<(), GaveUp> {
        let start = interpreter.bytecode.pc();
        if !self.entries.get(start).is_some_and(|is_entry| *is_entry) {
            return Ok(());
        }
        let mut state = State { gas: interpreter.gas.remaining(), pc: start as u32, ..State::default() };
        find_memory(&mut state, interpreter);
        state.jumps = interpreter.bytecode.legacy_jump_table().expect("legacy bytecode").as_slice().as_ptr() as u32;
        let stack = interpreter.stack.data_mut();
        state.bottom = stack.as_ptr() as u32;
        state.stack = state.bottom + size_of_val(stack.as_slice()) as u32;
        state.limit = state.bottom + (crate::fast::STACK_LIMIT * size_of::<U256>()) as u32;
        state.interpreter = std::ptr::from_mut(interpreter) as u32;
        // SAFETY: the host put the function `run` of the module of this code in this place of the table. It leaves words
        // between `bottom` and `limit`, and all of them are initialized.
        unsafe {
            let run = std::mem::transmute::<usize, extern "C" fn(*mut State)>(self.run);
            run(&raw mut state);
            let words = (state.stack - state.bottom) as usize / size_of::<U256>();
            interpreter.stack.data_mut().set_len(words);
        }
        interpreter.gas.set_remaining(state.gas);
        interpreter.bytecode.relative_jump(state.pc as isize - start as isize);
        if state.gave_up == 0 { Ok(()) } else { Err(GaveUp) }
    }
}

/// Notes where memory and the data of the call are.
fn find_memory(state: &mut State, interpreter: &mut Interpreter<EthInterpreter>) {
    let ((memory, size), (data, data_size)) = crate::fast::buffers(interpreter);
    (state.memory, state.size) = (memory as u32, size as u32);
    (state.data, state.data_size) = (data as u32, data_size as u32);
}

/// Lets memory grow to hold `end` bytes; returns the gas that is left, or -1 if less than `keep` would be.
fn grow_to(state: &mut State, end: u64, gas: u64, keep: u64) -> i64 {
    // SAFETY: `Compiled::run` does not use it while compiled code runs
    let interpreter = unsafe { &mut *(state.interpreter as usize as *mut Interpreter<EthInterpreter>) };
    let words = end.div_ceil(size_of::<U256>() as u64);
    if words <= interpreter.gas.memory().words_num as u64 {
        return gas as i64;
    }
    let total = 3 * words + words * words / 512;
    let cost = interpreter.gas.memory_mut().set_words_num(words as usize, total).unwrap_or(u64::MAX);
    if gas < keep.saturating_add(cost) {
        state.gave_up = 1;
        return -1;
    }
    interpreter.memory.resize(words as usize * size_of::<U256>());
    find_memory(state, interpreter);
    (gas - cost) as i64
}

/// Lets memory grow, as `grow_to`.
///
/// # Safety
/// Compiled code calls it with the state that it was entered with.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn grow(state: *mut State, end: u32, gas: u64, keep: u64) -> i64 {
    grow_to(unsafe { &mut *state }, end as u64, gas, keep)
}

/// Copies memory to memory; returns what `grow` does. Places and count are less than 2^31.
///
/// # Safety
/// As `grow`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn copy(state: *mut State, to: u32, from: u32, count: u32, gas: u64, keep: u64) -> i64 {
    let state = unsafe { &mut *state };
    let cost = 3 * (count as u64).div_ceil(size_of::<U256>() as u64);
    if gas < keep + cost {
        state.gave_up = 1;
        return -1;
    }
    let mut left = (gas - cost) as i64;
    if count > 0 {
        let end = to.max(from) as u64 + count as u64;
        if end > state.size as u64 {
            left = grow_to(state, end, gas - cost, keep);
            if left < 0 {
                return left;
            }
        }
        let memory = state.memory as usize as *mut u8;
        // SAFETY: memory has `end` bytes
        unsafe { crate::fast::copy(memory.add(from as usize), memory.add(to as usize), count as usize) };
    }
    left
}

/// Calculates with the operands of the state; the result replaces the first.
///
/// # Safety
/// As `grow`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn calculate(state: *mut State, calculation: Calculation) {
    use revm::interpreter::instructions::i256::{i256_div, i256_mod};
    let state = unsafe { &mut *state };
    let [a, b, c] = state.operands.map(U256::from_limbs);
    let result = match calculation {
        Calculation::Divide => a.checked_div(b).unwrap_or_default(),
        Calculation::DivideSigned => i256_div(a, b),
        Calculation::Remainder => a.checked_rem(b).unwrap_or_default(),
        Calculation::RemainderSigned => i256_mod(a, b),
        Calculation::AddMod => a.add_mod(b, c),
        Calculation::MulMod => a.mul_mod(b, c),
        Calculation::ExtendSign => crate::fast::extend_sign(a, b),
        Calculation::ReadData => read_data(state, a),
    };
    state.operands[0] = *result.as_limbs();
}

/// Reads a word of the data of the call. Zeros follow the data.
fn read_data(state: &State, place: U256) -> U256 {
    // SAFETY: `find_memory` notes where the data is, which does not move while compiled code runs
    let data = unsafe { std::slice::from_raw_parts(state.data as usize as *const u8, state.data_size as usize) };
    let mut bytes = [0; size_of::<U256>()];
    if let Some(rest) = usize::try_from(place).ok().and_then(|place| data.get(place..)) {
        let count = rest.len().min(bytes.len());
        bytes[..count].copy_from_slice(&rest[..count]);
    }
    U256::from_be_bytes(bytes)
}
