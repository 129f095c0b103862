//! The instructions of a region, along each of its paths.

use crate::{
    function::{Op, at},
    helpers::{Helper, calculate},
    immediate_size,
    region::{REACH, Region, STATE},
    state::{Calculation, State},
    types,
    words::{Word, known, small},
};
use revm::{bytecode::opcode::*, primitives::U256};
use std::mem::offset_of;
use wasm_encoder::{BlockType, ValType};

/// Returns whether an instruction is translated; the interpreter executes all others.
pub fn is_translated(instruction: u8) -> bool {
    matches!(
        instruction,
        ADD..=MULMOD
            | SIGNEXTEND
            | LT..=SAR
            | CALLDATALOAD
            | CALLDATASIZE
            | POP..=MSTORE8
            | JUMP..=PC
            | JUMPDEST
            | MCOPY..=SWAP16
    )
}

impl Region<'_> {
    /// Translates what follows a position. gas: of the path so far. seen: the places of this path to which jumps lead.
    pub fn follow(&mut self, mut pc: usize, mut gas: u64, mut seen: Vec<usize>) {
        loop {
            let instruction = self.plan.code.get(pc).copied().unwrap_or(STOP);
            let is_far = self.path.taken > REACH - 24 || self.path.words.len() > REACH - 4;
            if !is_translated(instruction) || is_far {
                return self.leave(pc, gas);
            }
            let is_full = self.count > self.plan.budget;
            let is_long = self.count >= self.plan.budget * self.plan.budget;
            if seen.contains(&pc) || pc != self.start && (instruction == JUMPDEST && is_full || is_long) {
                return self.go_on(pc, gas);
            }
            if instruction == JUMPDEST {
                seen.push(pc);
            }
            self.count += 1;
            let before = gas;
            gas += self.plan.prices[instruction as usize] as u64;
            match instruction {
                JUMP => {
                    let target = self.pop();
                    return match (self.plan.target(target), target.value()) {
                        (Some(to), _) => self.jump(to, gas, seen, self.plan.budget),
                        (None, Some(_)) => {
                            self.push(target);
                            self.leave(pc, before)
                        }
                        (None, None) => self.jump_anywhere(target, gas),
                    };
                }
                JUMPI => {
                    let (target, condition) = (self.pop(), self.pop());
                    let Some(to) = self.plan.target(target) else {
                        self.push(condition);
                        self.push(target);
                        return self.leave(pc, before);
                    };
                    match condition.value() {
                        Some(U256::ZERO) => {}
                        Some(_) => return self.jump(to, gas, seen, self.plan.budget),
                        None => {
                            match condition {
                                Word::Bool(local) => _ = self.f.get(local),
                                _ => {
                                    let limbs = self.limbs(condition);
                                    self.f.push_any(&limbs).i64_const(0).i64_ne();
                                }
                            }
                            self.f.put().if_(BlockType::Empty);
                            let path = self.path.clone();
                            self.depth += 1;
                            self.jump(to, gas, seen.clone(), self.plan.budget / 2);
                            self.depth -= 1;
                            self.path = path;
                            self.f.put().end();
                            if self.count > self.plan.budget {
                                return self.go_on(pc + 1, gas);
                            }
                        }
                    }
                    pc += 1;
                }
                _ => {
                    self.execute(instruction, pc);
                    pc += 1 + immediate_size(instruction);
                }
            }
        }
    }

    /// Follows a jump, within the region if it has fewer instructions than the budget.
    fn jump(&mut self, to: usize, gas: u64, seen: Vec<usize>, budget: usize) {
        if to == self.start || seen.contains(&to) || self.count > budget {
            return self.go_on(to, gas);
        }
        self.follow(to, gas, seen)
    }

    /// Jumps to a place that is known at run time only. If it is none, the interpreter shall say so.
    fn jump_anywhere(&mut self, target: Word, gas: u64) {
        let limbs = self.limbs(target);
        let size = self.plan.code.len() as i64;
        self.f.push_any(&limbs[1..]).i64_const(0).i64_ne();
        self.f.push(limbs[0]).i64_const(size).i64_ge_u().i32_or().if_(BlockType::Empty);
        self.give_up();
        self.f.put().end();
        self.f.push(limbs[0]).i32_wrap_i64();
        let place = self.f.keep(ValType::I32);
        self.f.get(STATE).i32_load(at(offset_of!(State, jumps)));
        self.f.get(place).i32_const(3).i32_shr_u().i32_add().i32_load8_u(at(0));
        self.f.get(place).i32_const(7).i32_and().i32_shr_u().i32_const(1).i32_and().i32_eqz().if_(BlockType::Empty);
        self.give_up();
        self.f.put().end();
        self.push_arguments(gas);
        self.f.get(place).return_call_indirect(0, types::REGION);
    }

    fn execute(&mut self, instruction: u8, pc: usize) {
        match instruction {
            JUMPDEST => {}
            PC => self.push(known(U256::from(pc))),
            PUSH0..=PUSH32 => {
                let value = self.plan.pushed(pc);
                self.push(known(value));
            }
            DUP1..=DUP16 => {
                let count = (instruction - DUP1) as usize + 1;
                self.reach(count);
                self.push(self.path.words[self.path.words.len() - count]);
            }
            SWAP1..=SWAP16 => {
                let count = (instruction - SWAP1) as usize + 2;
                self.reach(count);
                let top = self.path.words.len() - 1;
                self.path.words.swap(top, top + 1 - count);
            }
            POP => _ = self.pop(),
            CALLDATASIZE => {
                self.f.get(STATE).i64_load32_u(at(offset_of!(State, data_size)));
                let size = small(self.f.keep_limb());
                self.push(size);
            }
            MSTORE | MSTORE8 => {
                let (place, value) = (self.pop(), self.pop());
                if instruction == MSTORE { self.store(place, value) } else { self.store_byte(place, value) }
            }
            MCOPY => {
                let operands = [self.pop(), self.pop(), self.pop()];
                self.copy(operands);
            }
            _ => {
                let a = self.pop();
                let result = self.calculate(instruction, a);
                self.push(result);
            }
        }
    }

    /// Returns the result of an instruction that has one, and nothing else. a: its first operand.
    fn calculate(&mut self, instruction: u8, a: Word) -> Word {
        match instruction {
            ISZERO => return self.is_zero(a),
            NOT => return self.logic(Op::Xor, a, known(U256::MAX)),
            MLOAD => return self.load(a),
            CALLDATALOAD => return self.load_data(a),
            _ => {}
        }
        let b = self.pop();
        match instruction {
            ADD => self.add(a, b),
            MUL => self.multiply(a, b),
            SUB => self.subtract(a, b),
            DIV => self.divide(Helper::Divide, a, b),
            SDIV => self.divide(Helper::DivideSigned, a, b),
            MOD => self.divide(Helper::Remainder, a, b),
            SMOD => self.divide(Helper::RemainderSigned, a, b),
            LT => self.less(a, b, false),
            GT => self.less(b, a, false),
            SLT => self.less(a, b, true),
            SGT => self.less(b, a, true),
            EQ => self.equal(a, b),
            AND => self.logic(Op::And, a, b),
            OR => self.logic(Op::Or, a, b),
            XOR => self.logic(Op::Xor, a, b),
            BYTE => self.byte(a, b),
            SHL => self.shift(a, b, true, false),
            SHR => self.shift(a, b, false, false),
            SAR => self.shift(a, b, false, true),
            SIGNEXTEND => match self.extend_sign(a, b) {
                Some(word) => word,
                None => self.outside(Calculation::ExtendSign, &[a, b]),
            },
            ADDMOD | MULMOD => {
                let modulus = self.pop();
                let calculation = if instruction == ADDMOD { Calculation::AddMod } else { Calculation::MulMod };
                self.outside(calculation, &[a, b, modulus])
            }
            _ => unreachable!(),
        }
    }

    /// Leaves a calculation to evm.wasm.
    fn outside(&mut self, calculation: Calculation, operands: &[Word]) -> Word {
        let limbs: Vec<_> = operands.iter().map(|word| self.limbs(*word)).collect();
        Word::Limbs(calculate(&mut self.f, STATE, calculation, &limbs))
    }
}
