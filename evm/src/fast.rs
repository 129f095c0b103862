//! The common instructions, without what revm does around each of them.
//!
//! `run` executes instructions one after the other as long as each is one of those below and nothing is special about
//! it: enough gas, enough on the stack, memory that is there already, a valid jump. It stops in front of the first
//! instruction of which that is not true, with nothing of it done. revm executes that one, so every failure, every
//! call and every expansion of memory is decided by revm alone.

use revm::{
    bytecode::opcode,
    interpreter::{
        CallInput, Interpreter,
        interpreter::EthInterpreter,
        interpreter_types::{InputsTr, Jumps, MemoryTr},
    },
    primitives::U256,
};

/// The number of words that an EVM stack holds.
pub const STACK_LIMIT: usize = 1024;

const BASE: u64 = 2;
const VERY_LOW: u64 = 3;
const LOW: u64 = 5;
const MID: u64 = 8;
const HIGH: u64 = 10;
const JUMPDEST: u64 = 1;

pub fn run(interpreter: &mut Interpreter<EthInterpreter>) {
    let code = interpreter.bytecode.bytes_ref().as_ptr();
    let table = interpreter.bytecode.legacy_jump_table().expect("legacy bytecode");
    let (jumps, jump_count) = (table.as_slice().as_ptr(), table.len());
    let ((memory, size), (data, data_size)) = buffers(interpreter);
    let bottom = interpreter.stack.data_mut().as_mut_ptr();
    let start = interpreter.bytecode.pc();
    let mut at = start;
    let mut gas = interpreter.gas.remaining();

    // SAFETY: the code ends with STOP behind the last immediate; the stack has room for STACK_LIMIT words, of which those
    // before `end` are initialized; `memory` has `size` bytes and `data` has `data_size`, and nothing here moves them.
    unsafe {
        let limit = bottom.add(STACK_LIMIT);
        // behind the upper word of the stack
        let mut end = bottom.add(interpreter.stack.len());
        macro_rules! top {
            ($n:expr) => {
                &mut *end.sub(1 + $n)
            };
        }
        // leaves to revm what needs more gas or words than there are
        macro_rules! need {
            ($gas:expr, $words:expr) => {
                if gas < $gas || end < bottom.add($words) {
                    break;
                }
            };
        }
        macro_rules! room {
            ($gas:expr) => {
                if gas < $gas || end == limit {
                    break;
                }
            };
        }
        // completes an instruction: its gas, the words that it takes, the next position
        macro_rules! done {
            ($gas:expr, $words:expr, $next:expr) => {{
                gas -= $gas;
                end = end.sub($words);
                at = $next;
            }};
        }
        macro_rules! unary {
            ($gas:expr, |$a:ident| $value:expr) => {{
                need!($gas, 1);
                let a = top!(0);
                let $a = *a;
                *a = $value;
                done!($gas, 0, at + 1);
            }};
        }
        macro_rules! binary {
            ($gas:expr, |$a:ident, $b:ident| $value:expr) => {{
                need!($gas, 2);
                let ($a, b) = (*top!(0), top!(1));
                let $b = *b;
                *b = $value;
                done!($gas, 1, at + 1);
            }};
        }
        macro_rules! push {
            ($gas:expr, $value:expr, $next:expr) => {{
                room!($gas);
                *end = $value;
                end = end.add(1);
                gas -= $gas;
                at = $next;
            }};
        }
        macro_rules! valid {
            ($to:expr) => {
                $to < jump_count && *jumps.add($to >> 3) >> ($to & 7) & 1 == 1
            };
        }
        // Pushes a small number. With the instruction behind it, where nothing is special about both, it is one: a jump
        // with the JUMPDEST that it leads to, a load or a store at a fixed place, a shift by a fixed number of bits.
        macro_rules! push_small {
            ($value:expr, $next:expr) => {{
                let (value, next): (usize, usize) = ($value, $next);
                room!(VERY_LOW);
                match *code.add(next) {
                    opcode::MLOAD if gas >= 2 * VERY_LOW && value + 32 <= size => {
                        push!(2 * VERY_LOW, load(memory.add(value)), next + 1)
                    }
                    opcode::MSTORE if gas >= 2 * VERY_LOW && value + 32 <= size && end > bottom => {
                        store(memory.add(value), top!(0));
                        done!(2 * VERY_LOW, 1, next + 1)
                    }
                    opcode::JUMP if gas >= VERY_LOW + MID + JUMPDEST && valid!(value) => {
                        done!(VERY_LOW + MID + JUMPDEST, 0, value + 1)
                    }
                    opcode::JUMPI if gas >= VERY_LOW + HIGH + JUMPDEST && end > bottom && valid!(value) => {
                        if is_zero(top!(0)) {
                            done!(VERY_LOW + HIGH, 1, next + 1)
                        } else {
                            done!(VERY_LOW + HIGH + JUMPDEST, 1, value + 1)
                        }
                    }
                    opcode::SHL if gas >= 2 * VERY_LOW && value < 256 && end > bottom => {
                        *top!(0) = shift_left(top!(0), value);
                        done!(2 * VERY_LOW, 0, next + 1)
                    }
                    opcode::SHR if gas >= 2 * VERY_LOW && value < 256 && end > bottom => {
                        *top!(0) = shift_right(top!(0), value, 0);
                        done!(2 * VERY_LOW, 0, next + 1)
                    }
                    opcode::SAR if gas >= 2 * VERY_LOW && value < 256 && end > bottom => {
                        *top!(0) = shift_right(top!(0), value, sign(top!(0)));
                        done!(2 * VERY_LOW, 0, next + 1)
                    }
                    _ => push!(VERY_LOW, word(value as u64), next),
                }
            }};
        }
        loop {
            match *code.add(at) {
                opcode::ADD => binary!(VERY_LOW, |a, b| a.wrapping_add(b)),
                opcode::MUL => binary!(LOW, |a, b| multiply(a, b)),
                opcode::SUB => binary!(VERY_LOW, |a, b| a.wrapping_sub(b)),
                opcode::DIV => binary!(LOW, |a, b| divide(a, b)),
                opcode::SDIV => binary!(LOW, |a, b| {
                    let quotient = divide(magnitude(a), magnitude(b));
                    if sign(&a) == sign(&b) { quotient } else { quotient.wrapping_neg() }
                }),
                opcode::SIGNEXTEND => binary!(LOW, |a, b| extend_sign(a, b)),
                opcode::LT => binary!(VERY_LOW, |a, b| truth(less(&a, &b))),
                opcode::GT => binary!(VERY_LOW, |a, b| truth(less(&b, &a))),
                opcode::SLT => binary!(VERY_LOW, |a, b| truth(signed_less(&a, &b))),
                opcode::SGT => binary!(VERY_LOW, |a, b| truth(signed_less(&b, &a))),
                opcode::EQ => binary!(VERY_LOW, |a, b| truth(a == b)),
                opcode::ISZERO => unary!(VERY_LOW, |a| truth(is_zero(&a))),
                opcode::AND => binary!(VERY_LOW, |a, b| a & b),
                opcode::OR => binary!(VERY_LOW, |a, b| a | b),
                opcode::XOR => binary!(VERY_LOW, |a, b| a ^ b),
                opcode::NOT => unary!(VERY_LOW, |a| !a),
                opcode::BYTE => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(index) if index < 32 => word(b.as_limbs()[3 - index / 8] >> (56 - index % 8 * 8) & 255),
                    _ => U256::ZERO,
                }),
                opcode::SHL => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(bits) if bits < 256 => shift_left(&b, bits),
                    _ => U256::ZERO,
                }),
                opcode::SHR => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(bits) if bits < 256 => shift_right(&b, bits, 0),
                    _ => U256::ZERO,
                }),
                opcode::SAR => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(bits) if bits < 256 => shift_right(&b, bits, sign(&b)),
                    _ => U256::from_limbs([sign(&b); 4]),
                }),
                opcode::CALLDATALOAD => {
                    need!(VERY_LOW, 1);
                    match small(top!(0)) {
                        Some(place) if place + 32 <= data_size => *top!(0) = load(data.add(place)),
                        _ => break,
                    }
                    done!(VERY_LOW, 0, at + 1);
                }
                opcode::CALLDATASIZE => push!(BASE, word(data_size as u64), at + 1),
                opcode::POP => {
                    need!(BASE, 1);
                    done!(BASE, 1, at + 1);
                }
                opcode::MLOAD => {
                    need!(VERY_LOW, 1);
                    match small(top!(0)) {
                        Some(place) if place + 32 <= size => *top!(0) = load(memory.add(place)),
                        _ => break,
                    }
                    done!(VERY_LOW, 0, at + 1);
                }
                opcode::MSTORE => {
                    need!(VERY_LOW, 2);
                    match small(top!(0)) {
                        Some(place) if place + 32 <= size => store(memory.add(place), top!(1)),
                        _ => break,
                    }
                    done!(VERY_LOW, 2, at + 1);
                }
                opcode::MSTORE8 => {
                    need!(VERY_LOW, 2);
                    match small(top!(0)) {
                        Some(place) if place < size => *memory.add(place) = top!(1).as_limbs()[0] as u8,
                        _ => break,
                    }
                    done!(VERY_LOW, 2, at + 1);
                }
                opcode::MCOPY => {
                    need!(VERY_LOW, 3);
                    let (Some(to), Some(from), Some(count)) = (small(top!(0)), small(top!(1)), small(top!(2))) else {
                        break;
                    };
                    let cost = VERY_LOW * (1 + count.div_ceil(32) as u64);
                    if gas < cost || to + count > size || from + count > size {
                        break;
                    }
                    copy(memory.add(from), memory.add(to), count);
                    done!(cost, 3, at + 1);
                }
                opcode::JUMP => {
                    need!(MID, 1);
                    match small(top!(0)) {
                        Some(to) if valid!(to) => done!(MID, 1, to),
                        _ => break,
                    }
                }
                opcode::JUMPI => {
                    need!(HIGH, 2);
                    if is_zero(top!(1)) {
                        done!(HIGH, 2, at + 1);
                    } else {
                        match small(top!(0)) {
                            Some(to) if valid!(to) => done!(HIGH, 2, to),
                            _ => break,
                        }
                    }
                }
                opcode::JUMPDEST => {
                    need!(JUMPDEST, 0);
                    done!(JUMPDEST, 0, at + 1);
                }
                opcode::PUSH0 => push!(BASE, U256::ZERO, at + 1),
                opcode::PUSH1 => push_small!(*code.add(at + 1) as usize, at + 2),
                opcode::PUSH2 => push_small!((*code.add(at + 1) as usize) << 8 | *code.add(at + 2) as usize, at + 3),
                push @ opcode::PUSH3..=opcode::PUSH32 => {
                    let next = at + 1 + (push - opcode::PUSH0) as usize;
                    push!(VERY_LOW, immediate(code, at + 1, next), next)
                }
                dup @ opcode::DUP1..=opcode::DUP16 => {
                    let count = (dup - opcode::DUP1) as usize;
                    need!(VERY_LOW, count + 1);
                    push!(VERY_LOW, *top!(count), at + 1);
                }
                swap @ opcode::SWAP1..=opcode::SWAP16 => {
                    let count = (swap - opcode::SWAP1) as usize + 1;
                    need!(VERY_LOW, count + 1);
                    std::ptr::swap(top!(0), top!(count));
                    done!(VERY_LOW, 0, at + 1);
                }
                _ => break,
            }
        }
        interpreter.stack.data_mut().set_len(end.offset_from_unsigned(bottom));
    }
    interpreter.gas.set_remaining(gas);
    interpreter.bytecode.relative_jump(at as isize - start as isize);
}

#[inline(always)]
fn word(value: u64) -> U256 {
    U256::from_limbs([value, 0, 0, 0])
}

#[inline(always)]
fn truth(value: bool) -> U256 {
    word(value as u64)
}

/// Returns a word that is a place or a size; None where it is beyond all of them.
#[inline(always)]
fn small(value: &U256) -> Option<usize> {
    let [low, rest @ ..] = *value.as_limbs();
    (low >> 31 | rest[0] | rest[1] | rest[2] == 0).then_some(low as usize)
}

#[inline(always)]
fn is_zero(value: &U256) -> bool {
    let [a, b, c, d] = *value.as_limbs();
    a | b | c | d == 0
}

/// Returns the sign of a number in each bit of a limb.
#[inline(always)]
fn sign(value: &U256) -> u64 {
    (value.as_limbs()[3] as i64 >> 63) as u64
}

/// Returns where the memory and the data of a call are, with their sizes in bytes.
#[inline(always)]
pub fn buffers(interpreter: &mut Interpreter<EthInterpreter>) -> ((*mut u8, usize), (*const u8, usize)) {
    let size = interpreter.memory.size();
    let memory = interpreter.memory.slice_mut(0, size).as_mut_ptr();
    let data = match interpreter.input.input() {
        CallInput::Bytes(bytes) => (bytes.as_ptr(), bytes.len()),
        CallInput::SharedBuffer(range) => (interpreter.memory.global_slice(range.clone()).as_ptr(), range.len()),
    };
    ((memory, size), data)
}

/// Extends the sign of a number whose highest byte is that of an index, from the lowest.
#[inline(always)]
pub fn extend_sign(index: U256, value: U256) -> U256 {
    match small(&index) {
        Some(byte) if byte < 31 => {
            let raised = shift_left(&value, 248 - 8 * byte);
            shift_right(&raised, 248 - 8 * byte, sign(&raised))
        }
        _ => value,
    }
}

#[inline(always)]
fn magnitude(value: U256) -> U256 {
    if sign(&value) == 0 { value } else { value.wrapping_neg() }
}

#[inline(always)]
fn less(a: &U256, b: &U256) -> bool {
    let (a, b) = (a.as_limbs(), b.as_limbs());
    for i in [3, 2, 1] {
        if a[i] != b[i] {
            return a[i] < b[i];
        }
    }
    a[0] < b[0]
}

#[inline(always)]
fn signed_less(a: &U256, b: &U256) -> bool {
    let (high, other) = (a.as_limbs()[3] as i64, b.as_limbs()[3] as i64);
    if high != other { high < other } else { less(a, b) }
}

#[inline(always)]
fn shift_left(value: &U256, bits: usize) -> U256 {
    let limbs = value.as_limbs();
    let (limb, bit) = (bits / 64, bits % 64);
    let part = |i: usize| if i < 4 { limbs[i] } else { 0 };
    let mut shifted = [0; 4];
    for (i, each) in shifted.iter_mut().enumerate() {
        let (high, low) = (part(i.wrapping_sub(limb)), part(i.wrapping_sub(limb + 1)));
        *each = high << bit | low >> 1 >> (63 - bit);
    }
    U256::from_limbs(shifted)
}

#[inline(always)]
fn shift_right(value: &U256, bits: usize, sign: u64) -> U256 {
    let limbs = value.as_limbs();
    let (limb, bit) = (bits / 64, bits % 64);
    let part = |i: usize| if i < 4 { limbs[i] } else { sign };
    let mut shifted = [0; 4];
    for (i, each) in shifted.iter_mut().enumerate() {
        *each = part(i + limb) >> bit | part(i + limb + 1) << 1 << (63 - bit);
    }
    U256::from_limbs(shifted)
}

#[inline(always)]
fn multiply(a: U256, b: U256) -> U256 {
    // limbs of 0 cost nothing, and most factors are small
    let ([_, a1, a2, a3], mut rows, mut columns) = (*a.as_limbs(), *b.as_limbs(), *a.as_limbs());
    if a1 | a2 | a3 == 0 {
        (rows, columns) = (columns, rows);
    }
    let mut product = [0u64; 4];
    for i in 0..4 {
        if rows[i] == 0 {
            continue;
        }
        let mut carry = 0;
        for j in 0..3 - i {
            let (low, high) = wide(rows[i], columns[j]);
            let (sum, over) = product[i + j].overflowing_add(low);
            let (sum, more) = sum.overflowing_add(carry);
            product[i + j] = sum;
            carry = high + over as u64 + more as u64;
        }
        product[3] = product[3].wrapping_add(carry).wrapping_add(rows[i].wrapping_mul(columns[3 - i]));
    }
    U256::from_limbs(product)
}

/// Returns the two limbs of a product. WebAssembly has no such instruction, and would call a function for `u128`.
#[inline(always)]
fn wide(a: u64, b: u64) -> (u64, u64) {
    const LOW: u64 = u32::MAX as u64;
    let ((a_high, a_low), (b_high, b_low)) = ((a >> 32, a & LOW), (b >> 32, b & LOW));
    let cross = a_low * b_high;
    let middle = (a_low * b_low >> 32) + (cross & LOW) + a_high * b_low;
    (a.wrapping_mul(b), a_high * b_high + (cross >> 32) + (middle >> 32))
}

#[inline(always)]
fn divide(a: U256, b: U256) -> U256 {
    let ([x, a1, a2, a3], [y, b1, b2, b3]) = (*a.as_limbs(), *b.as_limbs());
    if a1 | a2 | a3 | b1 | b2 | b3 == 0 {
        return word(x.checked_div(y).unwrap_or(0));
    }
    if is_zero(&b) { U256::ZERO } else { a.wrapping_div(b) }
}

/// Reads the immediate at `begin..end` of a code, up to 32 bytes.
///
/// # Safety
/// The code must have `end` bytes.
#[inline(always)]
unsafe fn immediate(code: *const u8, begin: usize, end: usize) -> U256 {
    if end < 32 {
        return unsafe { std::slice::from_raw_parts(code.add(begin), end - begin) }
            .iter()
            .fold(U256::ZERO, |value, byte| value << 8 | word(*byte as u64));
    }
    // what stands before it is read too, and masked
    let limbs = *unsafe { load(code.add(end - 32)) }.as_limbs();
    let bits = 8 * (end - begin);
    U256::from_limbs(std::array::from_fn(|i| match bits.saturating_sub(64 * i) {
        0 => 0,
        1..64 => limbs[i] & ((1 << (bits % 64)) - 1),
        64.. => limbs[i],
    }))
}

/// Copies memory to memory, which may overlap.
///
/// # Safety
/// Both must have `count` bytes.
#[inline(always)]
pub unsafe fn copy(from: *const u8, to: *mut u8, count: usize) {
    unsafe {
        match count {
            // what a call of the copying routine would cost more than
            3 => to.cast::<[u8; 3]>().write(from.cast::<[u8; 3]>().read()),
            8 => to.cast::<[u8; 8]>().write(from.cast::<[u8; 8]>().read()),
            _ => std::ptr::copy(from, to, count),
        }
    }
}

/// Reads a word of memory.
///
/// # Safety
/// There must be 32 bytes.
#[inline(always)]
unsafe fn load(bytes: *const u8) -> U256 {
    #[cfg(target_feature = "simd128")]
    unsafe {
        use core::arch::wasm32::{v128_load, v128_store};
        let (high, low) = (reverse(v128_load(bytes.cast())), reverse(v128_load(bytes.add(16).cast())));
        let mut limbs = [0u64; 4];
        v128_store(limbs.as_mut_ptr().cast(), low);
        v128_store(limbs.as_mut_ptr().add(2).cast(), high);
        U256::from_limbs(limbs)
    }
    #[cfg(not(target_feature = "simd128"))]
    unsafe {
        U256::from_be_bytes(*bytes.cast::<[u8; 32]>())
    }
}

/// Writes a word of memory.
///
/// # Safety
/// There must be 32 bytes.
#[inline(always)]
unsafe fn store(bytes: *mut u8, value: &U256) {
    #[cfg(target_feature = "simd128")]
    unsafe {
        use core::arch::wasm32::{v128_load, v128_store};
        let limbs = value.as_limbs().as_ptr();
        v128_store(bytes.cast(), reverse(v128_load(limbs.add(2).cast())));
        v128_store(bytes.add(16).cast(), reverse(v128_load(limbs.cast())));
    }
    #[cfg(not(target_feature = "simd128"))]
    unsafe {
        *bytes.cast::<[u8; 32]>() = value.to_be_bytes();
    }
}

#[cfg(target_feature = "simd128")]
#[inline(always)]
fn reverse(bytes: core::arch::wasm32::v128) -> core::arch::wasm32::v128 {
    core::arch::wasm32::i8x16_shuffle::<15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0>(bytes, bytes)
}
