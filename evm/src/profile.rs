//! The gas of each instruction, by the functions that lead to it and by stage.

use revm::{
    interpreter::{
        GasTable, Host, InstructionResult, InstructionTable, Interpreter,
        interpreter::EthInterpreter,
        interpreter_types::{Jumps, LoopControl},
    },
    primitives::{Address, HashMap},
};

const JUMP: u8 = 0x56;
const JUMPI: u8 = 0x57;

/// What is known of a position of a code. Numbers are the host's; 0 is none.
#[derive(Clone, Copy, Default)]
pub struct Place {
    /// The stage that begins here.
    stage: u8,
    /// What a jump does: 1 if it enters a function, 2 if it leaves one.
    jump: u8,
    /// The function of the source that contains the instruction.
    function: u16,
    /// The function that begins here.
    entry: u16,
}

impl Place {
    const SIZE: usize = 6;

    /// Reads places, each in 6 bytes: stage, jump, function and entry, the last two with the low byte first.
    pub fn read(bytes: &[u8]) -> Vec<Place> {
        bytes
            .chunks_exact(Self::SIZE)
            .map(|each| Place {
                stage: each[0],
                jump: each[1],
                function: u16::from_le_bytes([each[2], each[3]]),
                entry: u16::from_le_bytes([each[4], each[5]]),
            })
            .collect()
    }
}

/// The places of a contract, and its number.
pub type Described = (u32, Vec<Place>);

/// A function with its callers; one for all calls by the same way. `entry` is the position at which it begins, 0 for the
/// contract itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Function {
    parent: u32,
    contract: u32,
    entry: u32,
}

/// Function, stage, and the first position in units of pages.
type Page = (u32, u8, usize);

/// Positions of a page.
const PAGE: usize = 64;

/// The parent of the first function.
const NONE: u32 = u32::MAX;

/// A call that is open.
struct Call<'a> {
    described: Option<&'a Described>,
    function: u32,
    stage: u8,
    /// Function and stage of each caller within the contract, and the position to which the function returns.
    returns: Vec<(u32, u8, usize)>,
    /// The position of the instruction that called another contract, and the gas before it.
    pending: Option<(usize, u64)>,
    /// The gas of the call that this one made last.
    called: u64,
}

pub struct Profile<'a> {
    described: &'a HashMap<Address, Described>,
    functions: Vec<Function>,
    numbers: HashMap<Function, u32>,
    /// Count and gas of each position, by pages of neighbouring positions, and the page that was used last.
    pages: Vec<[(u32, u64); PAGE]>,
    page_numbers: HashMap<Page, usize>,
    last: (Page, usize),
    calls: Vec<Call<'a>>,
}

impl<'a> Profile<'a> {
    pub fn new(described: &'a HashMap<Address, Described>) -> Self {
        Self {
            described,
            functions: Vec::new(),
            numbers: HashMap::default(),
            pages: Vec::new(),
            page_numbers: HashMap::default(),
            last: ((NONE, 0, 0), 0),
            calls: Vec::new(),
        }
    }

    /// Runs a frame until it ends or calls another contract; `depth` counts from 0.
    pub fn run<H: Host>(
        &mut self,
        depth: usize,
        interpreter: &mut Interpreter<EthInterpreter>,
        instructions: &InstructionTable<EthInterpreter, H>,
        costs: &GasTable,
        host: &mut H,
    ) -> InstructionResult {
        if depth == self.calls.len() {
            self.open(interpreter.input.bytecode_address);
        }
        self.calls.truncate(depth + 1);
        let mut call = self.calls.pop().expect("the call was opened");
        let mut gas = interpreter.gas.remaining();
        if let Some((at, before)) = call.pending.take() {
            // the contract that was called counts its own gas
            self.add(&call, at, before - gas - call.called);
        }
        let end = loop {
            let (at, opcode) = (interpreter.bytecode.pc(), interpreter.bytecode.opcode());
            if let Some((_, places)) = call.described {
                let stage = places.get(at).map_or(0, |place| place.stage);
                call.stage = if stage == 0 { call.stage } else { stage };
            }
            let result = interpreter.step(instructions, costs, host);
            let after = interpreter.gas.remaining();
            match result {
                Ok(()) => self.add(&call, at, gas - after),
                Err(end) => {
                    let calls = interpreter.bytecode.action().as_ref().is_some_and(|action| !action.is_return());
                    if calls {
                        call.pending = Some((at, gas));
                        call.called = 0;
                    } else {
                        self.add(&call, at, gas - after);
                        let used = interpreter.gas.limit() - after;
                        if let (Some(caller), Some(_)) = (self.calls.last_mut(), call.described) {
                            caller.called = used;
                        }
                    }
                    break end;
                }
            }
            gas = after;
            let to = interpreter.bytecode.pc();
            if (opcode == JUMP || opcode == JUMPI) && to != at + 1 {
                self.jump(&mut call, at, to);
            }
        };
        self.calls.push(call);
        end
    }

    fn open(&mut self, address: Option<Address>) {
        let described = address.and_then(|address| self.described.get(&address));
        let (parent, stage) = self.calls.last().map_or((NONE, 0), |caller| (caller.function, caller.stage));
        let function = described.map_or(parent, |(contract, _)| self.number(parent, *contract, 0));
        self.calls.push(Call { described, function, stage, returns: Vec::new(), pending: None, called: 0 });
    }

    fn jump(&mut self, call: &mut Call<'a>, at: usize, to: usize) {
        let Some((contract, places)) = call.described else { return };
        let place = |at: usize| places.get(at).copied().unwrap_or_default();
        match place(at).jump {
            1 => {
                call.returns.push((call.function, call.stage, at + 1));
                call.function = self.number(call.function, *contract, to as u32);
            }
            2 => {
                let entered = self.functions[call.function as usize].entry as usize;
                if let Some(open) = call.returns.iter().rposition(|&(_, _, back)| back == to) {
                    (call.function, call.stage, _) = call.returns[open];
                    call.returns.truncate(open);
                } else if ![0, place(entered).entry].contains(&place(to).function)
                    && let Some((function, stage, _)) = call.returns.pop()
                {
                    (call.function, call.stage) = (function, stage);
                }
                // else a common end of several functions, which the compiler made
            }
            _ => {}
        }
    }

    fn number(&mut self, parent: u32, contract: u32, entry: u32) -> u32 {
        let function = Function { parent, contract, entry };
        *self.numbers.entry(function).or_insert_with(|| {
            self.functions.push(function);
            self.functions.len() as u32 - 1
        })
    }

    fn add(&mut self, call: &Call, at: usize, gas: u64) {
        if call.described.is_some() {
            let page = (call.function, call.stage, at / PAGE);
            if self.last.0 != page {
                let number = *self.page_numbers.entry(page).or_insert_with(|| {
                    self.pages.push([(0, 0); PAGE]);
                    self.pages.len() - 1
                });
                self.last = (page, number);
            }
            let (count, sum) = &mut self.pages[self.last.1][at % PAGE];
            *count += 1;
            *sum += gas;
        }
    }

    /// Returns the number of functions; of each its parent, contract and entry; then of each position function, stage,
    /// position, count, and gas, the low half first.
    pub fn table(self) -> Vec<u32> {
        let mut words = vec![self.functions.len() as u32];
        words.extend(self.functions.iter().flat_map(|each| [each.parent, each.contract, each.entry]));
        let mut pages: Vec<_> = self.page_numbers.into_iter().collect();
        pages.sort_unstable();
        for ((function, stage, page), number) in pages {
            for (place, &(count, gas)) in self.pages[number].iter().enumerate().filter(|(_, (count, _))| *count > 0) {
                let at = (page * PAGE + place) as u32;
                words.extend([function, stage as u32, at, count, gas as u32, (gas >> 32) as u32]);
            }
        }
        words
    }
}
