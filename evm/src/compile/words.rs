//! Arithmetic of words, written as instructions on their limbs.

use crate::{
    function::{Limb, Limbs, NOUGHT, Op},
    helpers::Helper,
    region::{Region, STATE},
};
use revm::primitives::U256;
use std::array::from_fn;
use wasm_encoder::ValType;

/// A word on the stack of the EVM.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// The word that stood so far below the top of the stack when the region was entered.
    Slot(usize),
    /// 0 or 1, in a local of 32 bits.
    Bool(u32),
    Limbs(Limbs),
}

pub fn known(value: U256) -> Word {
    Word::Limbs(value.as_limbs().map(Limb::Known))
}

pub fn small(limb: Limb) -> Word {
    Word::Limbs([limb, NOUGHT, NOUGHT, NOUGHT])
}

impl Word {
    pub fn value(self) -> Option<U256> {
        let Word::Limbs(limbs) = self else { return None };
        let mut value = [0; 4];
        for (part, limb) in value.iter_mut().zip(limbs) {
            let Limb::Known(each) = limb else { return None };
            *part = each;
        }
        Some(U256::from_limbs(value))
    }

    /// Returns a limb if it is known without a load.
    fn known_limb(self, i: usize) -> Option<Limb> {
        match self {
            Word::Limbs(limbs) => Some(limbs[i]).filter(|limb| matches!(limb, Limb::Known(_))),
            Word::Bool(_) => (i > 0).then_some(NOUGHT),
            Word::Slot(_) => None,
        }
    }
}

/// Returns n where a word is known to be 2^n.
fn power(word: Word) -> Option<usize> {
    word.value().filter(|value| value.count_ones() == 1).map(|value| value.trailing_zeros())
}

impl Region<'_> {
    pub fn add(&mut self, a: Word, b: Word) -> Word {
        let (a, b, f) = (self.limbs(a), self.limbs(b), &mut self.f);
        let mut carry = NOUGHT;
        Word::Limbs(from_fn(|i| {
            let part = f.op(Op::Add, a[i], b[i]);
            let sum = f.op(Op::Add, part, carry);
            if i < 3 {
                let (over, more) = (f.op(Op::LtU, part, b[i]), f.op(Op::LtU, sum, carry));
                carry = f.op(Op::Or, over, more);
            }
            sum
        }))
    }

    pub fn subtract(&mut self, a: Word, b: Word) -> Word {
        let (a, b, f) = (self.limbs(a), self.limbs(b), &mut self.f);
        let mut borrow = NOUGHT;
        Word::Limbs(from_fn(|i| {
            let part = f.op(Op::Sub, a[i], b[i]);
            let difference = f.op(Op::Sub, part, borrow);
            if i < 3 {
                let (over, more) = (f.op(Op::LtU, a[i], b[i]), f.op(Op::LtU, part, borrow));
                borrow = f.op(Op::Or, over, more);
            }
            difference
        }))
    }

    pub fn multiply(&mut self, a: Word, b: Word) -> Word {
        if let Some(bits) = power(a) {
            return self.shift_left(b, bits);
        }
        if let Some(bits) = power(b) {
            return self.shift_left(a, bits);
        }
        let (a, b) = (self.limbs(a), self.limbs(b));
        if [&a[1..], &b[1..]].concat().iter().all(|limb| *limb == NOUGHT) {
            self.f.push_all(&[a[0], b[0]]);
            self.f.put().call(Helper::Wide.index());
            let high = self.f.keep_limb();
            return Word::Limbs([self.f.keep_limb(), high, NOUGHT, NOUGHT]);
        }
        self.helped(Helper::Multiply, &[a, b].concat())
    }

    /// Returns what a helper leaves for these limbs.
    pub fn helped(&mut self, helper: Helper, limbs: &[Limb]) -> Word {
        self.f.push_all(limbs);
        if helper.takes_state() {
            self.f.get(STATE);
        }
        self.f.put().call(helper.index());
        Word::Limbs(self.f.keep_limbs())
    }

    pub fn logic(&mut self, op: Op, a: Word, b: Word) -> Word {
        if let (Word::Bool(a), Word::Bool(b)) = (a, b) {
            self.f.get(a);
            let mut sink = self.f.get(b);
            match op {
                Op::And => sink.i32_and(),
                Op::Or => sink.i32_or(),
                _ => sink.i32_xor(),
            };
            return Word::Bool(self.f.keep(ValType::I32));
        }
        Word::Limbs(from_fn(|i| {
            // a limb that the other operand decides is not loaded
            let decided = match (op, a.known_limb(i), b.known_limb(i)) {
                (Op::And, Some(NOUGHT), _) | (Op::And, _, Some(NOUGHT)) => Some(NOUGHT),
                _ => None,
            };
            decided.unwrap_or_else(|| {
                let (a, b) = (self.limb(a, i), self.limb(b, i));
                self.f.op(op, a, b)
            })
        }))
    }

    pub fn is_zero(&mut self, a: Word) -> Word {
        match a {
            Word::Bool(local) => _ = self.f.get(local).i32_eqz(),
            _ => {
                if let Some(value) = a.value() {
                    return known(U256::from(value.is_zero()));
                }
                let limbs = self.limbs(a);
                self.f.push_any(&limbs).i64_eqz();
            }
        }
        Word::Bool(self.f.keep(ValType::I32))
    }

    pub fn equal(&mut self, a: Word, b: Word) -> Word {
        let difference = self.logic(Op::Xor, a, b);
        self.is_zero(difference)
    }

    pub fn less(&mut self, a: Word, b: Word, is_signed: bool) -> Word {
        let is_sign = is_signed && b.value() == Some(U256::ZERO);
        let (a, b, f) = (self.limbs(a), self.limbs(b), &mut self.f);
        if is_sign {
            f.push(a[3]).i64_const(0).i64_lt_s();
            return Word::Bool(f.keep(ValType::I32));
        }
        // the borrow of a - b, from the lowest limb
        f.push(a[0]);
        f.push(b[0]).i64_lt_u();
        let mut borrow = f.keep(ValType::I32);
        for i in 1..4 {
            if a[i] == b[i] {
                continue;
            }
            f.push(a[i]);
            f.push(b[i]);
            let mut sink = f.put();
            if i == 3 && is_signed {
                sink.i64_lt_s()
            } else {
                sink.i64_lt_u()
            };
            f.push(a[i]);
            f.push(b[i]).i64_eq();
            f.get(borrow).i32_and().i32_or();
            borrow = f.keep(ValType::I32);
        }
        Word::Bool(borrow)
    }

    pub fn shift_left(&mut self, a: Word, bits: usize) -> Word {
        let (limb, bit) = (bits / 64, bits % 64);
        Word::Limbs(from_fn(|i| match i.checked_sub(limb) {
            None => NOUGHT,
            Some(high) => {
                let low = if bit > 0 && high > 0 { self.limb(a, high - 1) } else { NOUGHT };
                let high = self.limb(a, high);
                self.funnel(high, low, bit)
            }
        }))
    }

    pub fn shift_right(&mut self, a: Word, bits: usize, is_signed: bool) -> Word {
        let fill = if is_signed { self.sign(a) } else { NOUGHT };
        let (limb, bit) = (bits / 64, bits % 64);
        Word::Limbs(from_fn(|i| match i + limb {
            3 => {
                let top = self.limb(a, 3);
                self.f.op(if is_signed { Op::ShrS } else { Op::ShrU }, top, Limb::Known(bit as u64))
            }
            low @ 0..3 if bit == 0 => self.limb(a, low),
            low @ 0..3 => {
                let (high, low) = (self.limb(a, low + 1), self.limb(a, low));
                self.funnel(high, low, 64 - bit)
            }
            _ => fill,
        }))
    }

    /// Returns the upper 64 bits of two limbs, shifted to the left by less than 64.
    fn funnel(&mut self, high: Limb, low: Limb, bits: usize) -> Limb {
        if bits == 0 {
            return high;
        }
        let upper = self.f.op(Op::Shl, high, Limb::Known(bits as u64));
        let lower = self.f.op(Op::ShrU, low, Limb::Known(64 - bits as u64));
        self.f.op(Op::Or, upper, lower)
    }

    fn sign(&mut self, a: Word) -> Limb {
        let top = self.limb(a, 3);
        self.f.op(Op::ShrS, top, Limb::Known(63))
    }

    /// Shifts by what a word says. left: whether to the left.
    pub fn shift(&mut self, bits: Word, a: Word, left: bool, is_signed: bool) -> Word {
        match bits.value() {
            Some(bits) if bits < U256::from(256) => {
                let bits = bits.as_limbs()[0] as usize;
                if left { self.shift_left(a, bits) } else { self.shift_right(a, bits, is_signed) }
            }
            Some(_) if is_signed => {
                let fill = self.sign(a);
                Word::Limbs([fill; 4])
            }
            Some(_) => known(U256::ZERO),
            None => {
                let helper = match (left, is_signed) {
                    (true, _) => Helper::ShiftLeft,
                    (_, false) => Helper::ShiftRight,
                    (_, true) => Helper::ShiftSigned,
                };
                let limbs = [self.limbs(bits), self.limbs(a)].concat();
                self.helped(helper, &limbs)
            }
        }
    }

    pub fn byte(&mut self, index: Word, a: Word) -> Word {
        match index.value() {
            Some(index) if index < U256::from(32) => {
                let bits = 8 * (31 - index.as_limbs()[0] as usize);
                let limb = self.limb(a, bits / 64);
                let shifted = self.f.op(Op::ShrU, limb, Limb::Known(bits as u64 % 64));
                small(self.f.op(Op::And, shifted, Limb::Known(255)))
            }
            Some(_) => known(U256::ZERO),
            None => {
                let limbs = [self.limbs(index), self.limbs(a)].concat();
                self.helped(Helper::Byte, &limbs)
            }
        }
    }

    /// Extends the sign of a number whose highest byte is known; None if it is not.
    pub fn extend_sign(&mut self, byte: Word, a: Word) -> Option<Word> {
        let byte = byte.value()?;
        if byte > U256::from(30) {
            return Some(a);
        }
        let bits = 8 * byte.as_limbs()[0] + 7;
        let (limb, above) = (bits as usize / 64, Limb::Known(63 - bits % 64));
        let top = self.limb(a, limb);
        let raised = self.f.op(Op::Shl, top, above);
        let top = self.f.op(Op::ShrS, raised, above);
        let fill = self.f.op(Op::ShrS, top, Limb::Known(63));
        Some(Word::Limbs(from_fn(|i| match i.cmp(&limb) {
            std::cmp::Ordering::Less => self.limb(a, i),
            std::cmp::Ordering::Equal => top,
            std::cmp::Ordering::Greater => fill,
        })))
    }

    pub fn divide(&mut self, helper: Helper, a: Word, b: Word) -> Word {
        match (helper, power(b)) {
            (Helper::Divide, Some(bits)) => self.shift_right(a, bits, false),
            (Helper::Remainder, Some(_)) => {
                let mask = known(b.value().unwrap_or_default() - U256::ONE);
                self.logic(Op::And, a, mask)
            }
            _ => {
                let limbs = [self.limbs(a), self.limbs(b)].concat();
                self.helped(helper, &limbs)
            }
        }
    }
}
