//! Functions of every module: what would be long where it is used. They take and leave the limbs of words, the lowest
//! first.

use crate::{
    function::{Function, Limb, Limbs, NOUGHT, Op, at},
    state::{Calculation, State},
    types,
};
use std::{array::from_fn, mem::offset_of};
use wasm_encoder::{BlockType, ValType};

/// Functions of evm.wasm that a module imports, in the order of their indices.
pub const IMPORTS: [(&str, u32); 3] =
    [("grow", types::GROW), ("copy", types::COPY), ("calculate", types::CALCULATE)];
pub const GROW: u32 = 0;
pub const COPY: u32 = 1;
const CALCULATE: u32 = 2;

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Helper {
    /// The product of two limbs.
    Wide,
    Multiply,
    ShiftLeft,
    ShiftRight,
    ShiftSigned,
    Byte,
    Divide,
    DivideSigned,
    Remainder,
    RemainderSigned,
}

impl Helper {
    pub const ALL: [Helper; 10] = [
        Helper::Wide,
        Helper::Multiply,
        Helper::ShiftLeft,
        Helper::ShiftRight,
        Helper::ShiftSigned,
        Helper::Byte,
        Helper::Divide,
        Helper::DivideSigned,
        Helper::Remainder,
        Helper::RemainderSigned,
    ];

    pub fn index(self) -> u32 {
        IMPORTS.len() as u32 + self as u32
    }

    /// Whether the state of the frame follows the limbs.
    pub fn takes_state(self) -> bool {
        self.type_index() == types::DIVIDE
    }

    pub fn type_index(self) -> u32 {
        match self {
            Helper::Wide => types::WIDE,
            Helper::Divide | Helper::DivideSigned | Helper::Remainder | Helper::RemainderSigned => types::DIVIDE,
            _ => types::TWO_WORDS,
        }
    }

    /// is_wide: whether a product of two limbs is one instruction.
    pub fn function(self, is_wide: bool) -> Function {
        match self {
            Helper::Wide => {
                let mut f = Function::new(2);
                let (low, high) = wide(&mut f, Limb::Local(0), Limb::Local(1), is_wide);
                f.push_all(&[low, high]);
                f
            }
            Helper::Multiply => multiply(is_wide),
            Helper::ShiftLeft | Helper::ShiftRight | Helper::ShiftSigned => shift(self),
            Helper::Byte => byte(),
            Helper::Divide => divide(Calculation::Divide),
            Helper::Remainder => divide(Calculation::Remainder),
            Helper::DivideSigned => divide_signed(Calculation::DivideSigned),
            Helper::RemainderSigned => divide_signed(Calculation::RemainderSigned),
        }
    }
}

/// Leaves a calculation to evm.wasm. state: the local of the frame's state.
pub fn calculate(f: &mut Function, state: u32, calculation: Calculation, operands: &[Limbs]) -> Limbs {
    for (i, limb) in operands.as_flattened().iter().enumerate() {
        f.get(state);
        f.push(*limb).i64_store(at(offset_of!(State, operands) + 8 * i));
    }
    f.get(state).i32_const(calculation as i32).call(CALCULATE);
    from_fn(|i| {
        f.get(state).i64_load(at(offset_of!(State, operands) + 8 * i));
        f.keep_limb()
    })
}

fn parameters(first: u32) -> Limbs {
    from_fn(|i| Limb::Local(first + i as u32))
}

/// Returns the two limbs of a product, by one instruction, or by products of 32 bits.
fn wide(f: &mut Function, a: Limb, b: Limb, is_wide: bool) -> (Limb, Limb) {
    if is_wide {
        f.push_all(&[a, b]);
        f.put().i64_mul_wide_u();
        let high = f.keep_limb();
        return (f.keep_limb(), high);
    }
    const HALF: Limb = Limb::Known(32);
    const MASK: Limb = Limb::Known(u32::MAX as u64);
    let (a_low, a_high) = (f.op(Op::And, a, MASK), f.op(Op::ShrU, a, HALF));
    let (b_low, b_high) = (f.op(Op::And, b, MASK), f.op(Op::ShrU, b, HALF));
    let (cross, low) = (f.op(Op::Mul, a_low, b_high), f.op(Op::Mul, a_low, b_low));
    let (middle, part) = (f.op(Op::ShrU, low, HALF), f.op(Op::And, cross, MASK));
    let middle = f.op(Op::Add, middle, part);
    let part = f.op(Op::Mul, a_high, b_low);
    let middle = f.op(Op::Add, middle, part);
    let (high, part) = (f.op(Op::Mul, a_high, b_high), f.op(Op::ShrU, cross, HALF));
    let high = f.op(Op::Add, high, part);
    let part = f.op(Op::ShrU, middle, HALF);
    (f.op(Op::Mul, a, b), f.op(Op::Add, high, part))
}

/// Pushes limbs joined by OR that are 0 where each word fits 64 bits with its sign; returns the signs.
fn push_misfit(f: &mut Function, words: [Limbs; 2]) -> [Limb; 2] {
    let signs = words.map(|word| f.op(Op::ShrS, word[0], Limb::Known(63)));
    let mut parts = Vec::new();
    for (word, sign) in words.iter().zip(signs) {
        for limb in &word[1..] {
            parts.push(f.op(Op::Xor, *limb, sign));
        }
    }
    f.push_any(&parts);
    signs
}

fn multiply(is_wide: bool) -> Function {
    let mut f = Function::new(8);
    let (a, b) = (parameters(0), parameters(4));
    let [a_sign, b_sign] = push_misfit(&mut f, [a, b]);
    f.put().i64_eqz().if_(BlockType::Empty);
    let (low, high) = wide(&mut f, a[0], b[0], is_wide);
    let (less, more) = (f.op(Op::And, a_sign, b[0]), f.op(Op::And, b_sign, a[0]));
    let high = f.op(Op::Sub, high, less);
    let high = f.op(Op::Sub, high, more);
    let fill = f.op(Op::ShrS, high, Limb::Known(63));
    f.push_all(&[low, high, fill, fill]);
    f.put().return_().end();
    let product: [u32; 4] = from_fn(|_| f.local(ValType::I64));
    for i in 0..4 {
        // a limb of 0 costs nothing
        f.push(a[i]).i64_const(0).i64_ne().if_(BlockType::Empty);
        let mut carry = NOUGHT;
        for j in 0..4 - i {
            let place = product[i + j];
            let sum = if i + j == 3 {
                let low = f.op(Op::Mul, a[i], b[j]);
                let sum = f.op(Op::Add, Limb::Local(place), low);
                f.op(Op::Add, sum, carry)
            } else {
                let (low, high) = wide(&mut f, a[i], b[j], is_wide);
                let part = f.op(Op::Add, Limb::Local(place), low);
                let sum = f.op(Op::Add, part, carry);
                let (over, more) = (f.op(Op::LtU, part, low), f.op(Op::LtU, sum, carry));
                let high = f.op(Op::Add, high, over);
                carry = f.op(Op::Add, high, more);
                sum
            };
            f.push(sum).local_set(place);
        }
        f.put().end();
    }
    f.push_all(&product.map(Limb::Local));
    f
}

fn shift(kind: Helper) -> Function {
    let mut f = Function::new(8);
    let (bits, word) = (parameters(0), parameters(4));
    let (is_left, is_signed) = (kind == Helper::ShiftLeft, kind == Helper::ShiftSigned);
    let fill = if is_signed { f.op(Op::ShrS, word[3], Limb::Known(63)) } else { NOUGHT };
    // the limb that comes to this place; counted from the other end where the shift is to the right
    let from = |i: usize, limbs: usize| match if is_left { i.checked_sub(limbs) } else { Some(i + limbs) } {
        Some(i) if i < 4 => word[i],
        _ => fill,
    };
    f.push_any(&bits[1..]);
    f.push(bits[0]).i64_const(255).i64_gt_u().i64_extend_i32_u().i64_or();
    f.put().i64_const(0).i64_ne().if_(BlockType::Empty);
    f.push_all(&[fill; 4]);
    f.put().return_().end();
    for limbs in [2, 1] {
        f.push(bits[0]).i64_const(64 * limbs as i64).i64_and().i64_const(0).i64_ne().if_(BlockType::Empty);
        f.push_all(&from_fn::<_, 4, _>(|i| from(i, limbs)));
        for limb in [7, 6, 5, 4] {
            f.put().local_set(limb);
        }
        f.put().end();
    }
    let bit = f.op(Op::And, bits[0], Limb::Known(63));
    let rest = f.op(Op::Sub, Limb::Known(63), bit);
    let (outward, inward) = if is_left { (Op::Shl, Op::ShrU) } else { (Op::ShrU, Op::Shl) };
    let shifted: Limbs = from_fn(|i| {
        let own = f.op(if is_signed && i == 3 { Op::ShrS } else { outward }, word[i], bit);
        match if is_left { i.checked_sub(1) } else { Some(i + 1).filter(|i| *i < 4) } {
            None => own,
            Some(next) => {
                let part = f.op(inward, word[next], Limb::Known(1));
                let part = f.op(inward, part, rest);
                f.op(Op::Or, own, part)
            }
        }
    });
    f.push_all(&shifted);
    f
}

fn byte() -> Function {
    let mut f = Function::new(8);
    let (index, word) = (parameters(0), parameters(4));
    f.push_any(&index[1..]);
    f.push(index[0]).i64_const(31).i64_gt_u().i64_extend_i32_u().i64_or();
    f.put().i64_const(0).i64_ne().if_(BlockType::Empty);
    f.push_all(&[NOUGHT; 4]);
    f.put().return_().end();
    let mut select = |first: Limb, second: Limb, below: i64| {
        f.push_all(&[first, second]);
        f.push(index[0]).i64_const(below).i64_ge_u().select();
        f.keep_limb()
    };
    let (low, high) = (select(word[0], word[1], 24), select(word[2], word[3], 8));
    let limb = select(low, high, 16);
    let place = f.op(Op::And, index[0], Limb::Known(7));
    let bits = f.op(Op::Shl, place, Limb::Known(3));
    let bits = f.op(Op::Sub, Limb::Known(56), bits);
    let shifted = f.op(Op::ShrU, limb, bits);
    let value = f.op(Op::And, shifted, Limb::Known(255));
    f.push_all(&[value, NOUGHT, NOUGHT, NOUGHT]);
    f
}

fn divide(calculation: Calculation) -> Function {
    let mut f = Function::new(9);
    let (a, b) = (parameters(0), parameters(4));
    f.push_any(&[&a[1..], &b[1..]].concat()).i64_eqz().if_(BlockType::Empty);
    f.push(b[0]).i64_eqz().if_(BlockType::Result(ValType::I64)).i64_const(0).else_();
    f.push_all(&[a[0], b[0]]);
    let mut sink = f.put();
    if calculation == Calculation::Divide {
        sink.i64_div_u().end()
    } else {
        sink.i64_rem_u().end()
    };
    f.push_all(&[NOUGHT; 3]);
    f.put().return_().end();
    rest(f, calculation)
}

fn divide_signed(calculation: Calculation) -> Function {
    let mut f = Function::new(9);
    let (a, b) = (parameters(0), parameters(4));
    push_misfit(&mut f, [a, b]);
    // neither 0 nor -1 as divisor
    f.push(b[0]).i64_const(1).i64_add().i64_const(2).i64_lt_u().i64_extend_i32_u().i64_or();
    f.put().i64_eqz().if_(BlockType::Empty);
    f.push_all(&[a[0], b[0]]);
    let mut sink = f.put();
    if calculation == Calculation::DivideSigned {
        sink.i64_div_s()
    } else {
        sink.i64_rem_s()
    };
    let value = f.keep_limb();
    let fill = f.op(Op::ShrS, value, Limb::Known(63));
    f.push_all(&[value, fill, fill, fill]);
    f.put().return_().end();
    rest(f, calculation)
}

/// Leaves the large numbers of a division to evm.wasm.
fn rest(mut f: Function, calculation: Calculation) -> Function {
    let result = calculate(&mut f, 8, calculation, &[parameters(0), parameters(4)]);
    f.push_all(&result);
    f
}
