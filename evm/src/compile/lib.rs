//! The bytecode of a contract, translated to a WebAssembly module that runs beside the interpreter.
//!
//! The module has a function for each region (see `region`), and is entered through `run` at any entry: the start of the
//! code, a JUMPDEST, or what follows an instruction that is not translated. It returns in front of the first instruction
//! that it leaves to the interpreter, with stack, memory and gas as the interpreter has them there. evm/src/compiled.rs is
//! the other side.
//!
//! It imports the memory of evm.wasm and four of its functions, so that it can change nothing else.

mod function;
mod helpers;
mod memory;
mod paths;
mod region;
mod state;
mod words;

use function::{Function, at};
use helpers::{Helper, IMPORTS};
use region::Region;
pub use state::{Calculation, State};
use revm::{
    bytecode::opcode,
    interpreter::instructions::{GasTable, gas_table_spec},
    primitives::{U256, hardfork::SpecId},
};
use std::mem::offset_of;
use wasm_encoder::{
    CodeSection, ConstExpr, ElementSection, Elements, EntityType, ExportKind, ExportSection, FunctionSection,
    ImportSection, MemoryType, Module, RefType, TableSection, TableType, TypeSection,
};
use words::Word;

/// Bytes of a code, and of the functions of a module, at most. A contract of 24 KB has a module of about 1 MB.
const MAX_CODE: usize = 1 << 17;
const MAX_MODULE: usize = 6 << 20;

/// The types of functions, by their index in the module.
mod types {
    use wasm_encoder::ValType::{self, I32, I64};

    pub const REGION: u32 = 0;
    pub const ON_STATE: u32 = 1;
    pub const GROW: u32 = 2;
    pub const COPY: u32 = 3;
    pub const CALCULATE: u32 = 4;
    pub const WIDE: u32 = 5;
    pub const TWO_WORDS: u32 = 6;
    pub const DIVIDE: u32 = 7;

    pub const ALL: [(&[ValType], &[ValType]); 8] = [
        (&[I32, I32, I32, I64, I32], &[]),
        (&[I32], &[]),
        (&[I32, I32, I64, I64], &[I64]),
        (&[I32, I32, I32, I32, I64, I64], &[I64]),
        (&[I32, I32], &[]),
        (&[I64; 2], &[I64; 2]),
        (&[I64; 8], &[I64; 4]),
        (&[I64, I64, I64, I64, I64, I64, I64, I64, I32], &[I64; 4]),
    ];
}

/// Returns for each position of a code whether it is a JUMPDEST, and whether the module can be entered there.
fn positions(code: &[u8]) -> (Vec<bool>, Vec<bool>) {
    let (mut jumps, mut entries) = (vec![false; code.len()], vec![false; code.len() + 1]);
    entries[0] = true;
    let mut pc = 0;
    while let Some(&instruction) = code.get(pc) {
        let next = pc + 1 + immediate_size(instruction);
        if instruction == opcode::JUMPDEST {
            (jumps[pc], entries[pc]) = (true, true);
        }
        let ends = matches!(instruction, opcode::STOP | opcode::RETURN | opcode::REVERT | opcode::INVALID);
        if !ends && !paths::is_translated(instruction) {
            entries[pc + 1] = true;
        }
        pc = next;
    }
    entries.truncate(code.len());
    (jumps, entries)
}

/// Returns for each position of a code whether its module can be entered there.
pub fn entries(code: &[u8]) -> Vec<bool> {
    positions(code).1
}

fn immediate_size(instruction: u8) -> usize {
    if (opcode::PUSH1..=opcode::PUSH32).contains(&instruction) { (instruction - opcode::PUSH0) as usize } else { 0 }
}

/// What regions know of the code, and of each other.
struct Plan {
    code: Vec<u8>,
    jumps: Vec<bool>,
    prices: GasTable,
    /// Instructions of a region, after which it ends at the next fork or JUMPDEST; in a line it has its square.
    budget: usize,
    /// The number of the region that begins at a position, and these positions by number.
    numbers: Vec<Option<u32>>,
    starts: Vec<usize>,
}

impl Plan {
    /// Returns the index of the function of the region that begins at a position.
    fn function_at(&mut self, pc: usize) -> u32 {
        let number = *self.numbers[pc].get_or_insert_with(|| {
            self.starts.push(pc);
            self.starts.len() as u32 - 1
        });
        FIRST_REGION + number
    }

    /// Returns where a jump leads, if that is known and a JUMPDEST.
    fn target(&self, word: Word) -> Option<usize> {
        let value = word.value().filter(|value| *value < U256::from(self.code.len()))?;
        Some(value.as_limbs()[0] as usize).filter(|pc| self.jumps[*pc])
    }

    /// Returns the word that a PUSH at a position pushes; behind the end of the code are zeros.
    fn pushed(&self, pc: usize) -> U256 {
        let size = immediate_size(self.code[pc]);
        let bytes = (pc + 1..=pc + size).map(|i| self.code.get(i).copied().unwrap_or(0));
        bytes.fold(U256::ZERO, |value, byte| value << 8 | U256::from(byte))
    }
}

const RUN: u32 = (IMPORTS.len() + Helper::ALL.len()) as u32;
const FIRST_REGION: u32 = RUN + 1;

/// Returns the module of a code; None if it would be too large. budget: of a region, in instructions. is_wide: whether the
/// host has `i64.mul_wide_u`.
// in its caller it would be compiled for speed
#[inline(never)]
pub fn translate(code: &[u8], budget: usize, is_wide: bool) -> Option<Vec<u8>> {
    if code.len() > MAX_CODE {
        return None;
    }
    let (jumps, entries) = positions(code);
    let mut plan = Plan {
        code: code.to_vec(),
        jumps,
        prices: gas_table_spec(SpecId::CANCUN),
        budget,
        numbers: vec![None; code.len() + 1],
        starts: Vec::new(),
    };
    for (pc, _) in entries.iter().enumerate().filter(|(_, is_entry)| **is_entry) {
        plan.function_at(pc);
    }
    let mut bodies = CodeSection::new();
    for helper in Helper::ALL {
        bodies.function(&helper.function(is_wide).finish());
    }
    bodies.function(&run().finish());
    let mut next = 0;
    while let Some(&start) = plan.starts.get(next) {
        bodies.function(&Region::translate(&mut plan, start).finish());
        if bodies.byte_len() > MAX_MODULE {
            return None;
        }
        next += 1;
    }
    Some(module(&plan, &bodies))
}

/// Continues with the region at the position of the state.
fn run() -> Function {
    let mut f = Function::new(1);
    for offset in [offset_of!(State, stack), offset_of!(State, memory), offset_of!(State, size)] {
        f.get(0).i32_load(at(offset));
    }
    f.get(0).i64_load(at(offset_of!(State, gas))).local_get(0);
    f.get(0).i32_load(at(offset_of!(State, pc))).call_indirect(0, types::REGION);
    f
}

fn module(plan: &Plan, bodies: &CodeSection) -> Vec<u8> {
    let mut signatures = TypeSection::new();
    for (parameters, results) in types::ALL {
        signatures.ty().function(parameters.iter().copied(), results.iter().copied());
    }
    let mut imports = ImportSection::new();
    for (name, signature) in IMPORTS {
        imports.import("evm", name, EntityType::Function(signature));
    }
    let memory = MemoryType { minimum: 0, maximum: None, memory64: false, shared: false, page_size_log2: None };
    imports.import("evm", "memory", memory);
    let mut functions = FunctionSection::new();
    for helper in Helper::ALL {
        functions.function(helper.type_index());
    }
    functions.function(types::ON_STATE);
    for _ in &plan.starts {
        functions.function(types::REGION);
    }
    let mut tables = TableSection::new();
    tables.table(TableType {
        element_type: RefType::FUNCREF,
        table64: false,
        minimum: plan.code.len() as u64 + 1,
        maximum: None,
        shared: false,
    });
    let mut exports = ExportSection::new();
    exports.export("run", ExportKind::Func, RUN);
    let mut elements = ElementSection::new();
    for (number, pc) in plan.starts.iter().enumerate() {
        let function = [FIRST_REGION + number as u32];
        elements.active(None, &ConstExpr::i32_const(*pc as i32), Elements::Functions(function.as_slice().into()));
    }
    let mut module = Module::new();
    module.section(&signatures).section(&imports).section(&functions).section(&tables).section(&exports);
    module.section(&elements).section(bodies);
    module.finish()
}
