//! Contracts in memory, and calls of them.

use crate::{
    compiled::{Compiled, GaveUp},
    fast,
    precompiles::Precompiles,
    profile::{Described, Place, Profile},
};
use revm::{
    Context, MainContext,
    bytecode::Bytecode,
    context::{
        BlockEnv, ContextSetters, Evm, TxEnv,
        result::{EVMError, ExecutionResult, HaltReason},
    },
    context_interface::{ContextTr, FrameStack, JournalTr, context::ContextError},
    database::{CacheDB, EmptyDB, WrapDatabaseRef},
    database_interface::DatabaseCommit,
    handler::{
        EthFrame, EvmTr, FrameInitOrResult, FrameResult, Handler, MainnetContext, MainnetHandler,
        evm::{ContextDbError, FrameInitResult},
        instructions::EthInstructions,
    },
    interpreter::{
        InterpreterAction, interpreter::EthInterpreter, interpreter_action::FrameInit, interpreter_types::LoopControl,
    },
    primitives::{Address, B256, Bytes, HashMap, KECCAK_EMPTY, TxKind, U256, address, hardfork::SpecId},
    state::{AccountInfo, EvmState},
};
use std::{cell::RefCell, convert::Infallible};

/// The sender of all calls, that of Python's embedded chains.
const SENDER: Address = address!("5ac61ed000000000000000000000000000000001");

#[derive(Clone, Copy, Default)]
pub enum Status {
    #[default]
    Success = 0,
    Revert = 1,
    OutOfGas = 2,
    /// Any other exceptional halt, or a call that was refused.
    Failure = 3,
}

#[derive(Default)]
pub struct Answer {
    pub status: Status,
    pub output: Bytes,
    /// The gas of the execution, without that of a transaction before it.
    pub gas: u64,
    /// The address of the contract that was created.
    pub created: Option<Address>,
}

#[derive(Default)]
pub struct Contracts {
    accounts: CacheDB<EmptyDB>,
    block: BlockEnv,
    described: HashMap<Address, Described>,
    /// Contracts that are compiled, by the hash of their code.
    compiled: HashMap<B256, Compiled>,
    /// The gas that contracts used in the interpreter since they were the busiest.
    interpreted: RefCell<HashMap<Address, u64>>,
}

impl Contracts {
    pub fn put(&mut self, address: Address, code: Bytes) {
        let accounts = &mut self.accounts;
        let replaced = accounts.cache.accounts.get(&address).map(|account| account.info.code_hash);
        // designators of delegations (EIP-7702) are not code before Prague
        accounts.insert_account_info(address, AccountInfo::default().with_code(Bytecode::new_legacy(code)));
        // `CacheDB` would keep every code for ever
        if let Some(hash) = replaced.filter(|hash| *hash != KECCAK_EMPTY)
            && !accounts.cache.accounts.values().any(|account| account.info.code_hash == hash)
        {
            accounts.cache.contracts.remove(&hash);
        }
    }

    /// Sets the block of later calls. The hashes of those before it come from `EmptyDB`.
    pub fn set_block(&mut self, number: u64, timestamp: u64, prevrandao: B256) {
        self.block.number = U256::from(number);
        self.block.timestamp = U256::from(timestamp);
        self.block.prevrandao = Some(prevrandao);
    }

    pub fn describe(&mut self, address: Address, places: &[u8]) {
        let number = self.described.len() as u32;
        self.described.entry(address).or_insert((number, Vec::new())).1 = Place::read(places);
    }

    /// Uses compiled code for the contract at an address from now on. run: its place in the table of functions.
    pub fn link(&mut self, address: Address, run: usize) {
        let Some(account) = self.accounts.cache.accounts.get(&address) else { return };
        let hash = account.info.code_hash;
        if let Some(code) = self.accounts.cache.contracts.get(&hash) {
            self.compiled.insert(hash, Compiled::new(run, code.original_byte_slice()));
        }
    }

    /// Returns the contract that used most gas in the interpreter since it was returned here, and that gas, if it is at
    /// least so much.
    pub fn busiest(&mut self, least: u64) -> Option<(Address, u64)> {
        let interpreted = self.interpreted.get_mut();
        let (address, _) = interpreted.iter().filter(|(_, gas)| **gas >= least).max_by_key(|(_, gas)| **gas)?;
        interpreted.remove_entry(&address.clone())
    }

    pub fn run(&self, kind: TxKind, data: Bytes, gas: u64) -> Answer {
        self.execute(kind, data, U256::ZERO, gas).0
    }

    /// Runs a transaction whose changes later calls find. The output of a creation is the address of the contract.
    pub fn send(&mut self, kind: TxKind, data: Bytes, value: U256, gas: u64) -> Answer {
        if !self.accounts.cache.accounts.contains_key(&SENDER) {
            // half of all: a transfer to the sender cannot exceed the largest balance
            self.accounts.insert_account_info(SENDER, AccountInfo::from_balance(U256::MAX >> 1));
        }
        let (mut answer, changes) = self.execute(kind, data, value, gas);
        self.accounts.commit(changes);
        if let Some(address) = answer.created {
            answer.output = Bytes::copy_from_slice(address.as_slice());
        }
        answer
    }

    /// Returns the answer of a call, and its table as `Profile::table` says.
    pub fn profile(&self, address: Address, data: Bytes, gas: u64) -> (Answer, Vec<u32>) {
        let profile = Some(Profile::new(&self.described));
        match self.transact(TxKind::Call(address), data, U256::ZERO, gas, &HashMap::default(), profile) {
            Ok((answer, _, profile)) => (answer, profile.map(|profile| profile.table()).unwrap_or_default()),
            Err(GaveUp) => unreachable!(),
        }
    }

    /// Runs a transaction with compiled code, and again in the interpreter where that gives up.
    fn execute(&self, kind: TxKind, data: Bytes, value: U256, gas: u64) -> (Answer, EvmState) {
        for compiled in [&self.compiled, &HashMap::default()] {
            if let Ok((answer, changes, _)) = self.transact(kind, data.clone(), value, gas, compiled, None) {
                return (answer, changes);
            }
        }
        unreachable!()
    }

    fn transact<'a>(
        &'a self,
        kind: TxKind,
        data: Bytes,
        value: U256,
        gas: u64,
        compiled: &'a HashMap<B256, Compiled>,
        profile: Option<Profile<'a>>,
    ) -> Result<(Answer, EvmState, Option<Profile<'a>>), GaveUp> {
        let context = Context::mainnet()
            .with_db(WrapDatabaseRef(&self.accounts))
            .with_block(self.block.clone())
            .modify_cfg_chained(|cfg| {
                cfg.set_spec_and_mainnet_gas_params(SpecId::CANCUN);
                cfg.tx_gas_limit_cap = Some(u64::MAX);
                cfg.disable_nonce_check = true;
            })
            .modify_block_chained(|block| block.gas_limit = u64::MAX);
        let mut evm = Evm::new(context, EthInstructions::new_mainnet_with_spec(SpecId::CANCUN), Precompiles::default());
        let mut transaction =
            TxEnv { caller: SENDER, kind, data, value, gas_limit: u64::MAX, gas_price: 0, ..TxEnv::default() };
        let initial = evm
            .ctx
            .cfg
            .gas_params
            .initial_tx_gas(&transaction.data, kind.is_create(), 0, 0, 0, None)
            .initial_total_gas();
        transaction.gas_limit = gas.saturating_add(initial);
        evm.ctx.set_tx(transaction);
        let mut runner = Runner { evm, compiled, gave_up: false, interpreted: &self.interpreted, profile };
        let result = MainnetHandler::<_, EVMError<Infallible>, EthFrame<EthInterpreter>>::default().run(&mut runner);
        if runner.gave_up {
            return Err(GaveUp);
        }
        let answer = match result {
            Ok(result) => {
                let gas = result.tx_gas_used().saturating_sub(initial);
                match result {
                    ExecutionResult::Success { output, .. } => {
                        let created = output.address().copied();
                        Answer { status: Status::Success, output: output.into_data(), gas, created }
                    }
                    ExecutionResult::Revert { output, .. } => {
                        Answer { status: Status::Revert, output, gas, ..Answer::default() }
                    }
                    ExecutionResult::Halt { reason: HaltReason::OutOfGas(_), .. } => {
                        Answer { status: Status::OutOfGas, gas, ..Answer::default() }
                    }
                    ExecutionResult::Halt { reason, .. } => failure(format!("{reason:?}"), gas),
                }
            }
            Err(error) => failure(format!("{error:?}"), 0),
        };
        let changes = runner.evm.ctx.journal_mut().finalize();
        Ok((answer, changes, runner.profile))
    }
}

fn failure(reason: String, gas: u64) -> Answer {
    Answer { status: Status::Failure, output: reason.into_bytes().into(), gas, ..Answer::default() }
}

type State<'a> = MainnetContext<WrapDatabaseRef<&'a CacheDB<EmptyDB>>>;
type Base<'a> = Evm<State<'a>, (), EthInstructions<EthInterpreter, State<'a>>, Precompiles, EthFrame<EthInterpreter>>;

/// The EVM of revm, but that frames run in compiled code, in `fast`, or under a profile.
struct Runner<'a> {
    evm: Base<'a>,
    compiled: &'a HashMap<B256, Compiled>,
    gave_up: bool,
    interpreted: &'a RefCell<HashMap<Address, u64>>,
    profile: Option<Profile<'a>>,
}

impl<'a> EvmTr for Runner<'a> {
    type Context = State<'a>;
    type Instructions = <Base<'a> as EvmTr>::Instructions;
    type Precompiles = <Base<'a> as EvmTr>::Precompiles;
    type Frame = EthFrame<EthInterpreter>;

    fn all(&self) -> (&Self::Context, &Self::Instructions, &Self::Precompiles, &FrameStack<Self::Frame>) {
        self.evm.all()
    }

    fn all_mut(
        &mut self,
    ) -> (&mut Self::Context, &mut Self::Instructions, &mut Self::Precompiles, &mut FrameStack<Self::Frame>) {
        self.evm.all_mut()
    }

    fn frame_init(
        &mut self,
        input: FrameInit,
    ) -> Result<FrameInitResult<'_, Self::Frame>, ContextDbError<Self::Context>> {
        self.evm.frame_init(input)
    }

    fn frame_run(&mut self) -> Result<FrameInitOrResult<Self::Frame>, ContextDbError<Self::Context>> {
        let depth = self.evm.frame_stack.index().unwrap_or(0);
        let frame = self.evm.frame_stack.get();
        let context = &mut self.evm.ctx;
        let (instructions, costs) = (self.evm.instruction.instruction_table(), self.evm.instruction.gas_table());
        let interpreter = &mut frame.interpreter;
        let compiled = interpreter.bytecode.hash().and_then(|hash| self.compiled.get(&hash));
        let end = match (&mut self.profile, compiled) {
            (Some(profile), _) => profile.run(depth, interpreter, instructions, costs, context),
            (None, Some(compiled)) => loop {
                if let Err(GaveUp) = compiled.run(interpreter) {
                    self.gave_up = true;
                    return Err(ContextError::Custom(String::new()));
                }
                if let Err(end) = interpreter.step(instructions, costs, context) {
                    break end;
                }
            },
            (None, None) => {
                let mut gas = 0;
                let end = loop {
                    let before = interpreter.gas.remaining();
                    fast::run(interpreter);
                    gas += before - interpreter.gas.remaining();
                    if let Err(end) = interpreter.step(instructions, costs, context) {
                        break end;
                    }
                };
                if let Some(address) = interpreter.input.bytecode_address {
                    *self.interpreted.borrow_mut().entry(address).or_default() += gas;
                }
                end
            }
        };
        if interpreter.bytecode.action().is_none() {
            interpreter.halt(end);
        }
        let action: InterpreterAction = interpreter.take_next_action();
        frame.process_next_action(context, action).inspect(|next| {
            if next.is_result() {
                frame.set_finished(true);
            }
        })
    }

    fn frame_return_result(
        &mut self,
        result: FrameResult,
    ) -> Result<Option<FrameResult>, ContextDbError<Self::Context>> {
        self.evm.frame_return_result(result)
    }
}
