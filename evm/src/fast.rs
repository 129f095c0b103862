//! The common instructions, without what revm does around each of them.
//!
//! `run` executes instructions one after the other as long as each is one of those below and nothing is special about
//! it: enough gas, enough on the stack, memory that is there already, a valid jump. It stops in front of the first
//! instruction of which that is not true, with nothing of it done. revm executes that one, so every failure, every
//! call and every expansion of memory is decided by revm alone.

use revm::{
    interpreter::{
        Interpreter,
        interpreter::EthInterpreter,
        interpreter_types::{Jumps, MemoryTr},
    },
    primitives::U256,
};

/// The number of words that an EVM stack holds.
const STACK_LIMIT: usize = 1024;

const VERY_LOW: u64 = 3;
const LOW: u64 = 5;

pub fn run(interpreter: &mut Interpreter<EthInterpreter>) {
    let code = interpreter.bytecode.bytes_ref().as_ptr();
    let table = interpreter.bytecode.legacy_jump_table().expect("legacy bytecode");
    let (jumps, jump_count) = (table.as_slice().as_ptr(), table.len());
    let size = interpreter.memory.size();
    let memory = interpreter.memory.slice_mut(0, size).as_mut_ptr();
    let bottom = interpreter.stack.data_mut().as_mut_ptr();
    let mut depth = interpreter.stack.len();
    let start = interpreter.bytecode.pc();
    let mut at = start;
    let mut gas = interpreter.gas.remaining();

    // SAFETY: the code ends with STOP behind the last immediate; the stack has room for STACK_LIMIT words, of which the
    // first `depth` are initialized; `memory` has `size` bytes, and nothing here moves either.
    unsafe {
        macro_rules! top {
            ($n:expr) => {
                &mut *bottom.add(depth - 1 - $n)
            };
        }
        // leaves to revm what needs more gas or words than there are
        macro_rules! need {
            ($gas:expr, $words:expr) => {
                if gas < $gas || depth < $words {
                    break;
                }
                gas -= $gas;
            };
        }
        macro_rules! binary {
            ($gas:expr, |$a:ident, $b:ident| $value:expr) => {{
                need!($gas, 2);
                let $a = *top!(0);
                depth -= 1;
                let b = top!(0);
                let $b = *b;
                *b = $value;
                at += 1;
            }};
        }
        macro_rules! room {
            ($gas:expr) => {
                if gas < $gas || depth == STACK_LIMIT {
                    break;
                }
                gas -= $gas;
            };
        }
        macro_rules! push {
            ($n:expr) => {{
                room!(VERY_LOW);
                *bottom.add(depth) = read::<$n>(code.add(at + 1));
                depth += 1;
                at += 1 + $n;
            }};
        }
        macro_rules! dup {
            ($n:expr) => {{
                if gas < VERY_LOW || depth < $n || depth == STACK_LIMIT {
                    break;
                }
                gas -= VERY_LOW;
                *bottom.add(depth) = *bottom.add(depth - $n);
                depth += 1;
                at += 1;
            }};
        }
        macro_rules! swap {
            ($n:expr) => {{
                need!(VERY_LOW, $n + 1);
                let (upper, lower) = (bottom.add(depth - 1), bottom.add(depth - 1 - $n));
                let (a, b) = (*upper, *lower);
                *upper = b;
                *lower = a;
                at += 1;
            }};
        }
        macro_rules! valid {
            ($to:expr) => {
                $to < jump_count && *jumps.add($to >> 3) >> ($to & 7) & 1 == 1
            };
        }
        loop {
            match *code.add(at) {
                0x01 => binary!(VERY_LOW, |a, b| a.wrapping_add(b)),
                0x02 => binary!(LOW, |a, b| multiply(a, b)),
                0x03 => binary!(VERY_LOW, |a, b| a.wrapping_sub(b)),
                0x04 => binary!(LOW, |a, b| divide(a, b)),
                0x05 => binary!(LOW, |a, b| {
                    let negative = is_negative(&a) != is_negative(&b);
                    let quotient = divide(magnitude(a), magnitude(b));
                    if negative { quotient.wrapping_neg() } else { quotient }
                }),
                0x10 => binary!(VERY_LOW, |a, b| truth(less(&a, &b))),
                0x11 => binary!(VERY_LOW, |a, b| truth(less(&b, &a))),
                0x12 => binary!(VERY_LOW, |a, b| truth(signed_less(&a, &b))),
                0x13 => binary!(VERY_LOW, |a, b| truth(signed_less(&b, &a))),
                0x14 => binary!(VERY_LOW, |a, b| truth(a == b)),
                0x15 => {
                    need!(VERY_LOW, 1);
                    let a = top!(0);
                    *a = truth(is_zero(a));
                    at += 1;
                }
                0x16 => binary!(VERY_LOW, |a, b| a & b),
                0x17 => binary!(VERY_LOW, |a, b| a | b),
                0x18 => binary!(VERY_LOW, |a, b| a ^ b),
                0x19 => {
                    need!(VERY_LOW, 1);
                    let a = top!(0);
                    *a = !*a;
                    at += 1;
                }
                0x1a => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(index) if index < 32 => word(b.as_limbs()[3 - index / 8] >> (56 - index % 8 * 8) & 255),
                    _ => U256::ZERO,
                }),
                0x1b => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(bits) if bits < 256 => shift_left(&b, bits),
                    _ => U256::ZERO,
                }),
                0x1c => binary!(VERY_LOW, |a, b| match small(&a) {
                    Some(bits) if bits < 256 => shift_right(&b, bits, 0),
                    _ => U256::ZERO,
                }),
                0x1d => binary!(VERY_LOW, |a, b| {
                    let sign = if is_negative(&b) { u64::MAX } else { 0 };
                    match small(&a) {
                        Some(bits) if bits < 256 => shift_right(&b, bits, sign),
                        _ => U256::from_limbs([sign; 4]),
                    }
                }),
                0x50 => {
                    need!(2, 1);
                    depth -= 1;
                    at += 1;
                }
                0x51 => {
                    if gas < VERY_LOW || depth < 1 {
                        break;
                    }
                    let a = top!(0);
                    match small(a) {
                        Some(place) if place + 32 <= size => *a = load(memory.add(place)),
                        _ => break,
                    }
                    gas -= VERY_LOW;
                    at += 1;
                }
                0x52 => {
                    if gas < VERY_LOW || depth < 2 {
                        break;
                    }
                    match small(top!(0)) {
                        Some(place) if place + 32 <= size => store(memory.add(place), top!(1)),
                        _ => break,
                    }
                    gas -= VERY_LOW;
                    depth -= 2;
                    at += 1;
                }
                0x53 => {
                    if gas < VERY_LOW || depth < 2 {
                        break;
                    }
                    match small(top!(0)) {
                        Some(place) if place < size => *memory.add(place) = top!(1).as_limbs()[0] as u8,
                        _ => break,
                    }
                    gas -= VERY_LOW;
                    depth -= 2;
                    at += 1;
                }
                0x56 => {
                    if gas < 8 || depth < 1 {
                        break;
                    }
                    match small(top!(0)) {
                        Some(to) if valid!(to) => at = to,
                        _ => break,
                    }
                    gas -= 8;
                    depth -= 1;
                }
                0x57 => {
                    if gas < 10 || depth < 2 {
                        break;
                    }
                    if is_zero(top!(1)) {
                        at += 1;
                    } else {
                        match small(top!(0)) {
                            Some(to) if valid!(to) => at = to,
                            _ => break,
                        }
                    }
                    gas -= 10;
                    depth -= 2;
                }
                0x5b => {
                    if gas < 1 {
                        break;
                    }
                    gas -= 1;
                    at += 1;
                }
                0x5f => {
                    room!(2);
                    *bottom.add(depth) = U256::ZERO;
                    depth += 1;
                    at += 1;
                }
                0x60 => push!(1),
                0x61 => push!(2),
                0x62 => push!(3),
                0x63 => push!(4),
                0x64 => push!(5),
                0x65 => push!(6),
                0x66 => push!(7),
                0x67 => push!(8),
                0x68 => push!(9),
                0x69 => push!(10),
                0x6a => push!(11),
                0x6b => push!(12),
                0x6c => push!(13),
                0x6d => push!(14),
                0x6e => push!(15),
                0x6f => push!(16),
                0x70 => push!(17),
                0x71 => push!(18),
                0x72 => push!(19),
                0x73 => push!(20),
                0x74 => push!(21),
                0x75 => push!(22),
                0x76 => push!(23),
                0x77 => push!(24),
                0x78 => push!(25),
                0x79 => push!(26),
                0x7a => push!(27),
                0x7b => push!(28),
                0x7c => push!(29),
                0x7d => push!(30),
                0x7e => push!(31),
                0x7f => push!(32),
                0x80 => dup!(1),
                0x81 => dup!(2),
                0x82 => dup!(3),
                0x83 => dup!(4),
                0x84 => dup!(5),
                0x85 => dup!(6),
                0x86 => dup!(7),
                0x87 => dup!(8),
                0x88 => dup!(9),
                0x89 => dup!(10),
                0x8a => dup!(11),
                0x8b => dup!(12),
                0x8c => dup!(13),
                0x8d => dup!(14),
                0x8e => dup!(15),
                0x8f => dup!(16),
                0x90 => swap!(1),
                0x91 => swap!(2),
                0x92 => swap!(3),
                0x93 => swap!(4),
                0x94 => swap!(5),
                0x95 => swap!(6),
                0x96 => swap!(7),
                0x97 => swap!(8),
                0x98 => swap!(9),
                0x99 => swap!(10),
                0x9a => swap!(11),
                0x9b => swap!(12),
                0x9c => swap!(13),
                0x9d => swap!(14),
                0x9e => swap!(15),
                0x9f => swap!(16),
                _ => break,
            }
        }
        interpreter.stack.data_mut().set_len(depth);
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

#[inline(always)]
fn is_negative(value: &U256) -> bool {
    (value.as_limbs()[3] as i64) < 0
}

#[inline(always)]
fn magnitude(value: U256) -> U256 {
    if is_negative(&value) { value.wrapping_neg() } else { value }
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
    let ([x, a1, a2, a3], [y, b1, b2, b3]) = (*a.as_limbs(), *b.as_limbs());
    if a1 | a2 | a3 | b1 | b2 | b3 == 0 {
        let product = x as u128 * y as u128;
        return U256::from_limbs([product as u64, (product >> 64) as u64, 0, 0]);
    }
    a.wrapping_mul(b)
}

#[inline(always)]
fn divide(a: U256, b: U256) -> U256 {
    let ([x, a1, a2, a3], [y, b1, b2, b3]) = (*a.as_limbs(), *b.as_limbs());
    if a1 | a2 | a3 | b1 | b2 | b3 == 0 {
        return word(x.checked_div(y).unwrap_or(0));
    }
    if is_zero(&b) { U256::ZERO } else { a.wrapping_div(b) }
}

/// Reads the `N` bytes of an immediate.
///
/// # Safety
/// There must be `N` bytes.
#[inline(always)]
unsafe fn read<const N: usize>(bytes: *const u8) -> U256 {
    let mut limbs = [0u64; 4];
    for i in 0..N {
        let byte = unsafe { *bytes.add(N - 1 - i) } as u64;
        limbs[i / 8] |= byte << (i % 8 * 8);
    }
    U256::from_limbs(limbs)
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
