//! Accesses to the EVM's memory and to the data of the call.
//!
//! `place` alone decides where memory is read and written: it returns a place after a check that memory has the bytes
//! there, and lets it grow where it has not.

use crate::{
    function::{Limb, Limbs, NOUGHT, at},
    helpers::{COPY, GROW, calculate},
    region::{GAS, MEMORY, Region, SIZE, STATE},
    state::{Calculation, State},
    words::Word,
};
use revm::primitives::U256;
use std::mem::offset_of;
use wasm_encoder::{BlockType, InstructionSink, ValType};

/// Places known while the code is translated are less; others are less than 2^31. Beyond, the interpreter decides.
const FAR: usize = 1 << 30;

/// Reverses the bytes of half a word.
const REVERSE: [u8; 16] = [15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0];

/// A place in the linear memory whose bytes are there: a local with an address, and a distance from it.
#[derive(Clone, Copy)]
struct Place(u32, usize);

impl Region<'_> {
    /// Returns the place of so many bytes of the EVM's memory.
    fn place(&mut self, word: Word, width: usize) -> Place {
        if let Some(place) = word.value().filter(|value| *value < U256::from(FAR)) {
            let place = place.as_limbs()[0] as usize;
            if place + width > self.path.memory {
                self.f.get(SIZE).i32_const((place + width) as i32).i32_lt_u().if_(BlockType::Empty);
                self.grow(|sink| _ = sink.i32_const((place + width) as i32));
                self.f.put().end();
                self.path.memory = place + width;
            }
            return Place(MEMORY, place);
        }
        let limbs = self.limbs(word);
        self.push_far(&limbs);
        let is_far = self.f.keep(ValType::I32);
        self.f.push(limbs[0]).i32_wrap_i64();
        let place = self.f.keep(ValType::I32);
        self.f.get(place).i32_const(width as i32).i32_add();
        let end = self.f.keep(ValType::I32);
        self.f.get(end).local_get(SIZE).i32_gt_u().local_get(is_far).i32_or().if_(BlockType::Empty);
        self.f.get(is_far).if_(BlockType::Empty);
        self.give_up();
        self.f.put().end();
        self.grow(|sink| _ = sink.local_get(end));
        self.f.put().end();
        self.f.get(MEMORY).local_get(place).i32_add();
        Place(self.f.keep(ValType::I32), 0)
    }

    /// Pushes whether a word is 2^31 or more.
    fn push_far(&mut self, limbs: &Limbs) {
        self.f.push_any(&limbs[1..]);
        self.f.push(limbs[0]).i64_const(31).i64_shr_u().i64_or().i64_const(0).i64_ne();
    }

    /// Lets memory grow to an end. If that needs more gas than there is, the call is given up.
    fn grow(&mut self, push_end: impl FnOnce(&mut InstructionSink)) {
        self.f.get(STATE);
        push_end(&mut self.f.put());
        self.f.get(GAS).local_get(self.keep).call(GROW);
        self.check_gas();
    }

    /// Takes the gas that a function left, or -1, and where memory is now.
    fn check_gas(&mut self) {
        self.f.put().local_tee(GAS).i64_const(0).i64_lt_s().if_(BlockType::Empty).return_().end();
        self.f.get(STATE).i32_load(at(offset_of!(State, memory))).local_set(MEMORY);
        self.f.get(STATE).i32_load(at(offset_of!(State, size))).local_set(SIZE);
    }

    pub fn load(&mut self, place: Word) -> Word {
        let place = self.place(place, 32);
        Word::Limbs(self.load_from(place))
    }

    fn load_from(&mut self, Place(base, distance): Place) -> Limbs {
        let mut limbs = [NOUGHT; 4];
        for half in [0, 1] {
            self.f.get(base).v128_load(at(distance + 16 * half));
            let bytes = self.f.keep(ValType::V128);
            self.f.get(bytes).local_get(bytes).i8x16_shuffle(REVERSE);
            let reversed = self.f.keep(ValType::V128);
            for lane in [0, 1] {
                self.f.get(reversed).i64x2_extract_lane(lane);
                limbs[2 * (1 - half) + lane as usize] = self.f.keep_limb();
            }
        }
        limbs
    }

    pub fn store(&mut self, place: Word, value: Word) {
        let limbs = self.limbs(value);
        let Place(base, distance) = self.place(place, 32);
        for half in [0, 1] {
            let (low, high) = (limbs[2 * (1 - half)], limbs[2 * (1 - half) + 1]);
            self.f.get(base);
            if let (Limb::Known(low), Limb::Known(high)) = (low, high) {
                let bytes = (high as u128) << 64 | low as u128;
                self.f.put().v128_const(bytes.swap_bytes() as i128);
            } else {
                self.f.push(low).i64x2_splat();
                if high != low {
                    self.f.push(high).i64x2_replace_lane(1);
                }
                let number = self.f.keep(ValType::V128);
                self.f.get(number).local_get(number).i8x16_shuffle(REVERSE);
            }
            self.f.put().v128_store(at(distance + 16 * half));
        }
    }

    pub fn store_byte(&mut self, place: Word, value: Word) {
        let low = self.limb(value, 0);
        let Place(base, distance) = self.place(place, 1);
        self.f.get(base);
        self.f.push(low).i64_store8(at(distance));
    }

    /// Copies memory to memory. operands: to, from, count.
    pub fn copy(&mut self, operands: [Word; 3]) {
        let limbs = operands.map(|word| self.limbs(word));
        for (i, each) in limbs.iter().enumerate() {
            self.push_far(each);
            if i > 0 {
                self.f.put().i32_or();
            }
        }
        self.f.put().if_(BlockType::Empty);
        self.give_up();
        self.f.put().end();
        self.f.get(STATE);
        for each in limbs {
            self.f.push(each[0]).i32_wrap_i64();
        }
        self.f.get(GAS).local_get(self.keep).call(COPY);
        self.check_gas();
    }

    /// Reads a word of the data of the call, with zeros beyond its end.
    pub fn load_data(&mut self, place: Word) -> Word {
        let limbs = self.limbs(place);
        let result: [u32; 4] = std::array::from_fn(|_| self.f.local(ValType::I64));
        self.push_far(&limbs);
        self.f.push(limbs[0]).i64_const(32).i64_add();
        self.f.get(STATE).i64_load32_u(at(offset_of!(State, data_size))).i64_gt_u().i32_or().i32_eqz();
        self.f.put().if_(BlockType::Empty);
        self.f.get(STATE).i32_load(at(offset_of!(State, data)));
        self.f.push(limbs[0]).i32_wrap_i64().i32_add();
        let base = self.f.keep(ValType::I32);
        for (limb, local) in self.load_from(Place(base, 0)).into_iter().zip(result) {
            self.f.push(limb).local_set(local);
        }
        self.f.put().else_();
        let read = calculate(&mut self.f, STATE, Calculation::ReadData, &[limbs]);
        for (limb, local) in read.into_iter().zip(result) {
            self.f.push(limb).local_set(local);
        }
        self.f.put().end();
        Word::Limbs(result.map(Limb::Local))
    }
}
