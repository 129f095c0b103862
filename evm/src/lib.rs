//! revm as a module of WebAssembly: an EVM, with the rules of Cancun, whose state is a few contracts.
//!
//! One instance serves one thread. Every call starts from the state that `put`, `deploy` and `send` left, in the block
//! of `set_block`, so that the same call always costs the same gas. The host writes arguments to memory from
//! `allocate`, and releases them afterwards; it reads an answer from `answer` before the next call. Addresses have 20
//! bytes.

mod calls;
mod compiled;
mod fast;
mod precompiles;
mod profile;

use calls::{Answer, Contracts};
use revm::primitives::{Address, B256, Bytes, TxKind, U256};
use std::cell::RefCell;

#[derive(Default)]
struct Instance {
    contracts: Contracts,
    answer: Answer,
    profile: Vec<u32>,
    module: Vec<u8>,
}

thread_local! {
    static INSTANCE: RefCell<Instance> = RefCell::default();
}

/// Returns room for that many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn allocate(size: usize) -> *mut u8 {
    let mut room = Vec::with_capacity(size.max(1));
    let start = room.as_mut_ptr();
    std::mem::forget(room);
    start
}

/// Releases what `allocate` returned for that size.
///
/// # Safety
/// `start` and `size` are those of one call of `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn release(start: *mut u8, size: usize) {
    drop(unsafe { Vec::from_raw_parts(start, 0, size.max(1)) });
}

/// Sets the code of a contract.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn put(address: *const u8, code: *const u8, size: usize) {
    let (address, code) = unsafe { (read_address(address), read(code, size)) };
    INSTANCE.with_borrow_mut(|instance| instance.contracts.put(address, code));
}

/// Sets the block of later calls: its number, its timestamp, and PREVRANDAO, which has 32 bytes. At first they are 0, 1
/// and 0.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn set_block(number: u64, timestamp: u64, prevrandao: *const u8) {
    let prevrandao = B256::from_slice(&unsafe { read(prevrandao, 32) });
    INSTANCE.with_borrow_mut(|instance| instance.contracts.set_block(number, timestamp, prevrandao));
}

/// Calls a contract with at most `gas` for the execution; returns a `Status`.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn call(address: *const u8, data: *const u8, size: usize, gas: u64) -> u32 {
    let (address, data) = unsafe { (read_address(address), read(data, size)) };
    run(TxKind::Call(address), data, gas)
}

/// Runs creation code with at most `gas`; returns a `Status`. The output is the code of the contract, which is not kept.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn create(data: *const u8, size: usize, gas: u64) -> u32 {
    let data = unsafe { read(data, size) };
    run(TxKind::Create, data, gas)
}

/// Runs creation code with at most `gas`, and keeps the contract; returns a `Status`. The output is its address.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deploy(data: *const u8, size: usize, gas: u64) -> u32 {
    let data = unsafe { read(data, size) };
    send_to(TxKind::Create, data, U256::ZERO, gas)
}

/// Calls a contract with a value of 32 bytes, and keeps what the call changes; returns a `Status`.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn send(address: *const u8, value: *const u8, data: *const u8, size: usize, gas: u64) -> u32 {
    let (address, value, data) = unsafe { (read_address(address), read(value, 32), read(data, size)) };
    send_to(TxKind::Call(address), data, U256::from_be_slice(&value), gas)
}

/// Translates a code to a WebAssembly module; returns its size in bytes, or 0 if it would be too large. `budget`: of a
/// region, in instructions. `is_wide`: not 0 if the host has `i64.mul_wide_u`.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn compile(code: *const u8, size: usize, budget: usize, is_wide: u32) -> usize {
    let module = shackled_compile::translate(&unsafe { read(code, size) }, budget, is_wide != 0).unwrap_or_default();
    INSTANCE.with_borrow_mut(|instance| {
        instance.module = module;
        instance.module.len()
    })
}

/// Returns the module that `compile` made last.
#[unsafe(no_mangle)]
pub extern "C" fn module() -> *const u8 {
    INSTANCE.with_borrow(|instance| instance.module.as_ptr())
}

/// Lets the contract at an address run compiled code from now on. `run` is the place of the module's function of this
/// name in the table of functions, where the host put it. The module imports memory and functions of this instance.
///
/// # Safety
/// The arguments lie in memory from `allocate`; the module is that of this code.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn link(address: *const u8, run: usize) {
    let address = unsafe { read_address(address) };
    INSTANCE.with_borrow_mut(|instance| instance.contracts.link(address, run));
}

/// Writes the address of the contract that used most gas in the interpreter since it was last written here; returns that
/// gas, or 0 if no contract used at least so much.
///
/// # Safety
/// The argument is room for an address.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn busiest(address: *mut u8, least: u64) -> u64 {
    let found = INSTANCE.with_borrow_mut(|instance| instance.contracts.busiest(least));
    let Some((busiest, gas)) = found else { return 0 };
    unsafe { std::slice::from_raw_parts_mut(address, 20) }.copy_from_slice(busiest.as_slice());
    gas
}

/// Describes the code of a contract for `profile`, by a `profile::Place` for each position. Contracts are numbered from 0
/// in the order in which they are described.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn describe(address: *const u8, places: *const u8, size: usize) {
    let (address, places) = unsafe { (read_address(address), read(places, size)) };
    INSTANCE.with_borrow_mut(|instance| instance.contracts.describe(address, &places));
}

/// Calls a contract, as `call` does, and counts the gas of each instruction.
///
/// # Safety
/// The arguments lie in memory from `allocate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn profile(address: *const u8, data: *const u8, size: usize, gas: u64) -> u32 {
    let (address, data) = unsafe { (read_address(address), read(data, size)) };
    INSTANCE.with_borrow_mut(|instance| {
        (instance.answer, instance.profile) = instance.contracts.profile(address, data, gas);
        instance.answer.status as u32
    })
}

/// Returns what the last call returned; of one that was not successful the data of the revert, or the reason as text.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    INSTANCE.with_borrow(|instance| instance.answer.output.as_ptr())
}

/// Returns the number of bytes of `answer`.
#[unsafe(no_mangle)]
pub extern "C" fn answer_size() -> usize {
    INSTANCE.with_borrow(|instance| instance.answer.output.len())
}

/// Returns the gas of the execution of the last call.
#[unsafe(no_mangle)]
pub extern "C" fn gas_used() -> u64 {
    INSTANCE.with_borrow(|instance| instance.answer.gas)
}

/// Returns the table of the last call of `profile`, as `profile::Profile::table` says.
#[unsafe(no_mangle)]
pub extern "C" fn table() -> *const u32 {
    INSTANCE.with_borrow(|instance| instance.profile.as_ptr())
}

/// Returns the number of words of 4 bytes of `table`.
#[unsafe(no_mangle)]
pub extern "C" fn table_size() -> usize {
    INSTANCE.with_borrow(|instance| instance.profile.len())
}

fn run(kind: TxKind, data: Bytes, gas: u64) -> u32 {
    INSTANCE.with_borrow_mut(|instance| {
        instance.answer = instance.contracts.run(kind, data, gas);
        instance.answer.status as u32
    })
}

fn send_to(kind: TxKind, data: Bytes, value: U256, gas: u64) -> u32 {
    INSTANCE.with_borrow_mut(|instance| {
        instance.answer = instance.contracts.send(kind, data, value, gas);
        instance.answer.status as u32
    })
}

unsafe fn read(start: *const u8, size: usize) -> Bytes {
    Bytes::copy_from_slice(unsafe { std::slice::from_raw_parts(start, size) })
}

unsafe fn read_address(start: *const u8) -> Address {
    Address::from_slice(unsafe { std::slice::from_raw_parts(start, 20) })
}
