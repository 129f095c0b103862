//! A WebAssembly function that is being written: instructions, and locals that keep what they leave on the stack.

use wasm_encoder::{InstructionSink, MemArg, MemArgTarget, ValType};

/// 64 bits of a word: known while the code is translated, or in a local.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Limb {
    Known(u64),
    Local(u32),
}

pub const NOUGHT: Limb = Limb::Known(0);
/// The limbs of a word, the lowest first.
pub type Limbs = [Limb; 4];

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Op {
    Add,
    Sub,
    Mul,
    And,
    Or,
    Xor,
    Shl,
    ShrU,
    ShrS,
    /// Whether the first is less: 0 or 1 in 64 bits.
    LtU,
}

impl Op {
    /// Returns the result where the operands say it: both are known, or one of them decides.
    fn fold(self, a: Limb, b: Limb) -> Option<Limb> {
        use Limb::Known;
        Some(match (self, a, b) {
            (_, Known(a), Known(b)) => Known(match self {
                Op::Add => a.wrapping_add(b),
                Op::Sub => a.wrapping_sub(b),
                Op::Mul => a.wrapping_mul(b),
                Op::And => a & b,
                Op::Or => a | b,
                Op::Xor => a ^ b,
                Op::Shl => a << (b & 63),
                Op::ShrU => a >> (b & 63),
                Op::ShrS => ((a as i64) >> (b & 63)) as u64,
                Op::LtU => (a < b) as u64,
            }),
            (Op::Add | Op::Sub | Op::Or | Op::Xor | Op::Shl | Op::ShrU | Op::ShrS, a, NOUGHT) => a,
            (Op::Add | Op::Or | Op::Xor, NOUGHT, b) => b,
            (Op::Shl | Op::ShrU | Op::ShrS | Op::And | Op::Mul, NOUGHT, _) => NOUGHT,
            (Op::And | Op::Mul | Op::LtU, _, NOUGHT) => NOUGHT,
            (Op::And, Known(u64::MAX), other) | (Op::And, other, Known(u64::MAX)) => other,
            (Op::Or, Known(u64::MAX), _) | (Op::Or, _, Known(u64::MAX)) => Known(u64::MAX),
            (Op::Sub | Op::Xor | Op::LtU, a, b) if a == b => NOUGHT,
            (Op::And | Op::Or, a, b) if a == b => a,
            _ => return None,
        })
    }

    fn write(self, sink: &mut InstructionSink) {
        match self {
            Op::Add => sink.i64_add(),
            Op::Sub => sink.i64_sub(),
            Op::Mul => sink.i64_mul(),
            Op::And => sink.i64_and(),
            Op::Or => sink.i64_or(),
            Op::Xor => sink.i64_xor(),
            Op::Shl => sink.i64_shl(),
            Op::ShrU => sink.i64_shr_u(),
            Op::ShrS => sink.i64_shr_s(),
            Op::LtU => sink.i64_lt_u().i64_extend_i32_u(),
        };
    }
}

#[derive(Default)]
pub struct Function {
    parameters: u32,
    locals: Vec<ValType>,
    body: Vec<u8>,
    /// Where the last instruction that set a local begins and ends, and the local.
    last_set: Option<(usize, usize, u32)>,
}

impl Function {
    pub fn new(parameters: u32) -> Self {
        Self { parameters, ..Self::default() }
    }

    pub fn put(&mut self) -> InstructionSink<'_> {
        InstructionSink::new(&mut self.body)
    }

    #[inline(never)]
    pub fn local(&mut self, kind: ValType) -> u32 {
        self.locals.push(kind);
        self.parameters + self.locals.len() as u32 - 1
    }

    #[inline(never)]
    pub fn get(&mut self, local: u32) -> InstructionSink<'_> {
        match self.last_set.take() {
            // set and get of the same local are a tee
            Some((begin, end, same)) if end == self.body.len() && same == local => {
                self.body.truncate(begin);
                self.put().local_tee(local);
            }
            _ => _ = self.put().local_get(local),
        }
        self.put()
    }

    #[inline(never)]
    pub fn set(&mut self, local: u32) {
        let begin = self.body.len();
        self.put().local_set(local);
        self.last_set = Some((begin, self.body.len(), local));
    }

    /// Moves what is on the stack to a new local.
    #[inline(never)]
    pub fn keep(&mut self, kind: ValType) -> u32 {
        let local = self.local(kind);
        self.set(local);
        local
    }

    #[inline(never)]
    pub fn keep_limb(&mut self) -> Limb {
        Limb::Local(self.keep(ValType::I64))
    }

    /// Moves the word on the stack, the lowest limb first, to new locals.
    #[inline(never)]
    pub fn keep_limbs(&mut self) -> Limbs {
        let [high, c, b, low] = std::array::from_fn(|_| self.keep_limb());
        [low, b, c, high]
    }

    #[inline(never)]
    pub fn push(&mut self, limb: Limb) -> InstructionSink<'_> {
        match limb {
            Limb::Known(value) => _ = self.put().i64_const(value as i64),
            Limb::Local(local) => _ = self.get(local),
        }
        self.put()
    }

    #[inline(never)]
    pub fn push_all(&mut self, limbs: &[Limb]) {
        for limb in limbs {
            self.push(*limb);
        }
    }

    /// Pushes the limbs, joined by OR.
    #[inline(never)]
    pub fn push_any(&mut self, limbs: &[Limb]) -> InstructionSink<'_> {
        let mut others = limbs.iter().filter(|limb| **limb != NOUGHT);
        self.push(*others.next().unwrap_or(&NOUGHT));
        for limb in others {
            self.push(*limb).i64_or();
        }
        self.put()
    }

    #[inline(never)]
    pub fn op(&mut self, op: Op, a: Limb, b: Limb) -> Limb {
        op.fold(a, b).unwrap_or_else(|| {
            self.push(a);
            self.push(b);
            op.write(&mut self.put());
            self.keep_limb()
        })
    }

    /// Returns what was written so far, and begins anew, with the same locals.
    pub fn take_body(&mut self) -> Vec<u8> {
        self.last_set = None;
        std::mem::take(&mut self.body)
    }

    #[inline(never)]
    pub fn append(&mut self, body: &[u8]) {
        self.body.extend(body);
    }

    #[inline(never)]
    pub fn finish(mut self) -> wasm_encoder::Function {
        self.put().end();
        let mut function = wasm_encoder::Function::new_with_locals_types(self.locals);
        function.raw(self.body);
        function
    }
}

/// Returns an access to memory at a fixed distance from the address on the stack.
pub fn at(offset: usize) -> MemArg {
    MemArg { offset: offset as u64, align: 0, target: MemArgTarget::Memory(0), ordering: None }
}
