//! A region: one function for the instructions from one position on, a tree of paths that ends where others begin.
//!
//! Words are limbs in locals, so that moves on the stack cost nothing; those that are left go to the stack's memory at
//! the end of each path, where the gas of the path is charged too. A region is entered only if there is gas for its
//! dearest path, and if no path leaves the bounds of the stack.

use crate::{
    Plan,
    function::{Function, Limb, Limbs, NOUGHT, at},
    state::State,
    words::Word,
};
use std::{array::from_fn, mem::offset_of};
use wasm_encoder::{BlockType, ValType};

/// The parameters of a region: the end of the stack, memory of the EVM and its size, gas, and the state of the frame.
pub const STACK: u32 = 0;
pub const MEMORY: u32 = 1;
pub const SIZE: u32 = 2;
pub const GAS: u32 = 3;
pub const STATE: u32 = 4;

/// Bytes of a word.
const WORD: usize = 32;
/// The words of the stack that a region reaches at most, below and above its end at entry.
pub const REACH: usize = 64;
/// A loop keeps so many words of the stack in locals at most.
const HOMES: usize = 24;

/// What a path knows.
#[derive(Clone, Default)]
pub struct Known {
    /// The words that the path put on the stack, above those that it left where they were.
    pub words: Vec<Word>,
    /// The words of the stack at entry that it took.
    pub taken: usize,
    /// Limbs that were loaded, by their slot.
    loaded: Vec<[Option<Limb>; 4]>,
    /// Words of 0 or 1 as limbs, by their local of 32 bits.
    bits: Vec<(u32, Limb)>,
    /// Bytes of the EVM's memory that are there for certain.
    pub memory: usize,
}

pub struct Region<'a> {
    pub plan: &'a mut Plan,
    pub start: usize,
    pub f: Function,
    pub path: Known,
    /// Words at entry that paths need, and words that they add.
    need: usize,
    height: usize,
    /// The gas of the dearest path.
    dearest: u64,
    /// Instructions so far.
    pub count: usize,
    /// The end of the stack at entry, less its reach; and the gas of the dearest path.
    low: u32,
    pub keep: u32,
    /// Of a loop, the locals of the stack's upper words.
    homes: Vec<Limbs>,
    is_loop: bool,
    /// Of a loop, the words that rounds change: a bit for each slot.
    changed: u64,
    /// The same, while it is not known to be a loop; None without a jump to its start.
    rounds: Option<u64>,
    /// Blocks that are open.
    pub depth: u32,
}

impl<'a> Region<'a> {
    /// Returns the function of the region that begins at a position.
    pub fn translate(plan: &'a mut Plan, start: usize) -> Function {
        let mut first = Region::new(&mut *plan, start);
        first.follow(start, 0, Vec::new());
        let need = first.need;
        let Some(changed) = first.rounds.take_if(|_| need <= HOMES) else { return first.finish() };
        let mut again = Region::new(plan, start);
        again.is_loop = true;
        again.homes = (0..need).map(|_| from_fn(|_| Limb::Local(again.f.local(ValType::I64)))).collect();
        again.changed = changed;
        again.follow(start, 0, Vec::new());
        again.finish()
    }

    fn new(plan: &'a mut Plan, start: usize) -> Self {
        let mut f = Function::new(5);
        let (low, keep) = (f.local(ValType::I32), f.local(ValType::I64));
        Self {
            plan,
            start,
            f,
            path: Known::default(),
            need: 0,
            height: 0,
            dearest: 0,
            count: 0,
            low,
            keep,
            homes: Vec::new(),
            is_loop: false,
            changed: 0,
            rounds: None,
            depth: 0,
        }
    }

    /// Writes what comes before the paths: their bounds, and the words of a loop.
    fn finish(mut self) -> Function {
        let body = self.f.take_body();
        self.f.get(STACK).i32_const((WORD * REACH) as i32).i32_sub().local_set(self.low);
        self.f.put().i64_const(self.dearest as i64).local_set(self.keep);
        self.f.get(GAS).local_get(self.keep).i64_lt_u();
        self.f.get(STACK).local_get(STATE).i32_load(at(offset_of!(State, bottom))).i32_sub();
        self.f.put().i32_const((WORD * self.need) as i32).i32_lt_u().i32_or();
        self.f.get(STATE).i32_load(at(offset_of!(State, limit))).local_get(STACK).i32_sub();
        self.f.put().i32_const((WORD * self.height) as i32).i32_lt_u().i32_or().if_(BlockType::Empty);
        let homes = std::mem::take(&mut self.homes);
        self.changed = 0;
        self.path = Known::default();
        self.leave(self.start, 0);
        self.f.put().end();
        for (slot, limbs) in homes.iter().enumerate() {
            for (i, limb) in limbs.iter().enumerate() {
                self.load_slot(slot, i);
                if let Limb::Local(local) = limb {
                    self.f.set(*local);
                }
            }
        }
        if self.is_loop {
            self.f.put().loop_(BlockType::Empty);
        }
        self.f.append(&body);
        if self.is_loop {
            self.f.put().end();
        }
        self.f.put().unreachable();
        self.f
    }

    // ---- the stack ----

    fn load_slot(&mut self, slot: usize, i: usize) {
        self.f.get(self.low).i64_load(at(WORD * (REACH - 1 - slot) + 8 * i));
    }

    pub fn limb(&mut self, word: Word, i: usize) -> Limb {
        match word {
            Word::Limbs(limbs) => limbs[i],
            Word::Bool(_) if i > 0 => NOUGHT,
            Word::Bool(local) => match self.path.bits.iter().find(|(bit, _)| *bit == local) {
                Some((_, limb)) => *limb,
                None => {
                    self.f.get(local).i64_extend_i32_u();
                    let limb = self.f.keep_limb();
                    self.path.bits.push((local, limb));
                    limb
                }
            },
            Word::Slot(slot) if slot < self.homes.len() => self.homes[slot][i],
            Word::Slot(slot) => {
                if self.path.loaded.len() <= slot {
                    self.path.loaded.resize(slot + 1, [None; 4]);
                }
                if let Some(limb) = self.path.loaded[slot][i] {
                    return limb;
                }
                self.load_slot(slot, i);
                let limb = self.f.keep_limb();
                self.path.loaded[slot][i] = Some(limb);
                limb
            }
        }
    }

    pub fn limbs(&mut self, word: Word) -> Limbs {
        from_fn(|i| self.limb(word, i))
    }

    /// Takes words of the stack at entry until there are so many.
    pub fn reach(&mut self, count: usize) {
        while self.path.words.len() < count {
            self.path.words.insert(0, Word::Slot(self.path.taken));
            self.path.taken += 1;
        }
        self.need = self.need.max(self.path.taken);
    }

    pub fn pop(&mut self) -> Word {
        self.reach(1);
        self.path.words.pop().unwrap_or(Word::Slot(0))
    }

    pub fn push(&mut self, word: Word) {
        self.path.words.push(word);
        self.height = self.height.max(self.path.words.len().saturating_sub(self.path.taken));
    }

    /// Returns the words that are not where they stood at entry: how many stand below each, and the word.
    fn moved(&self) -> Vec<(usize, Word)> {
        let is_at_home = |(j, word): &(usize, Word)| *word == Word::Slot(self.path.taken.wrapping_sub(1 + j));
        self.path.words.iter().copied().enumerate().filter(|each| !is_at_home(each)).collect()
    }

    /// Writes the words to the stack's memory; returns how many bytes it is higher than at entry.
    fn spill(&mut self) -> i32 {
        self.reach_homes();
        let mut all = self.moved();
        for slot in (0..REACH).filter(|slot| self.changed >> slot & 1 == 1) {
            // a round before may have changed it
            let j = self.path.taken - 1 - slot;
            if self.path.words.get(j) == Some(&Word::Slot(slot)) {
                all.push((j, Word::Slot(slot)));
            }
        }
        let all: Vec<_> = all.into_iter().map(|(j, word)| (j, self.limbs(word))).collect();
        for (j, limbs) in all {
            for (i, limb) in limbs.into_iter().enumerate() {
                self.f.get(self.low);
                self.f.push(limb).i64_store(at(WORD * (REACH + j - self.path.taken) + 8 * i));
            }
        }
        (WORD as i32) * (self.path.words.len() as i32 - self.path.taken as i32)
    }

    fn reach_homes(&mut self) {
        while self.path.taken < self.homes.len() {
            self.path.words.insert(0, Word::Slot(self.path.taken));
            self.path.taken += 1;
        }
    }

    // ---- the ends of paths ----

    pub fn charge(&mut self, gas: u64) {
        self.dearest = self.dearest.max(gas);
    }

    /// Returns to the interpreter in front of an instruction.
    pub fn leave(&mut self, pc: usize, gas: u64) {
        let rise = self.spill();
        self.charge(gas);
        self.f.get(STATE).local_get(STACK).i32_const(rise).i32_add().i32_store(at(offset_of!(State, stack)));
        self.f.get(STATE).local_get(GAS).i64_const(gas as i64).i64_sub().i64_store(at(offset_of!(State, gas)));
        self.f.get(STATE).i32_const(pc as i32).i32_store(at(offset_of!(State, pc))).return_();
    }

    /// Gives up the call: the interpreter runs it again from its start.
    pub fn give_up(&mut self) {
        self.f.get(STATE).i32_const(1).i32_store(at(offset_of!(State, gave_up))).return_();
    }

    pub fn push_arguments(&mut self, gas: u64) {
        let rise = self.spill();
        self.charge(gas);
        self.f.get(STACK).i32_const(rise).i32_add().local_get(MEMORY).local_get(SIZE);
        self.f.get(GAS).i64_const(gas as i64).i64_sub().local_get(STATE);
    }

    /// Continues with another region, or with the next round of this one.
    pub fn go_on(&mut self, pc: usize, gas: u64) {
        if pc == self.start && self.path.words.len() == self.path.taken {
            if self.is_loop {
                return self.iterate(gas);
            }
            let (moved, taken) = (self.moved(), self.path.taken);
            *self.rounds.get_or_insert_default() |= moved.iter().fold(0, |bits, (j, _)| bits | 1 << (taken - 1 - j));
        }
        self.push_arguments(gas);
        let function = self.plan.function_at(pc);
        self.f.put().return_call(function);
    }

    /// Begins the next round of a loop, or leaves in front of it where the gas does not suffice.
    fn iterate(&mut self, gas: u64) {
        self.reach_homes();
        self.charge(gas);
        let moved: Vec<_> = self.moved().iter().map(|(j, word)| (self.path.taken - 1 - j, self.limbs(*word))).collect();
        self.f.get(GAS).i64_const(gas as i64).i64_sub().local_set(GAS);
        for (_, limbs) in &moved {
            self.f.push_all(limbs);
        }
        for (slot, _) in moved.iter().rev() {
            for home in self.homes[*slot].iter().rev() {
                if let Limb::Local(local) = home {
                    self.f.put().local_set(*local);
                }
            }
        }
        self.f.get(GAS).local_get(self.keep).i64_ge_u().br_if(self.depth);
        self.path = Known::default();
        self.leave(self.start, 0);
    }
}
