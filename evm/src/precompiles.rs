//! Precompiled contracts. The contracts of pictures call none of those of cryptography, which would be two thirds of the
//! module: they are left out, and a call of one fails as a whole.

use revm::{
    context_interface::{Cfg, ContextTr},
    handler::{PrecompileProvider, precompile_output_to_interpreter_result},
    interpreter::{CallInputs, InterpreterResult},
    precompile::{identity, u64_to_address},
    primitives::AddressSet,
};

/// The last of Cancun; the first is 1.
const LAST: u64 = 10;

pub struct Precompiles {
    addresses: AddressSet,
}

impl Default for Precompiles {
    fn default() -> Self {
        Self { addresses: (1..=LAST).map(u64_to_address).collect() }
    }
}

impl<C: ContextTr> PrecompileProvider<C> for Precompiles {
    type Output = InterpreterResult;

    fn set_spec(&mut self, _: <C::Cfg as Cfg>::Spec) -> bool {
        false
    }

    fn run(&mut self, context: &mut C, inputs: &CallInputs) -> Result<Option<InterpreterResult>, String> {
        let address = &inputs.bytecode_address;
        if !self.addresses.contains(address) {
            return Ok(None);
        }
        if address != identity::FUN.address() {
            return Err(format!("the precompiled contract {address} is not part of this EVM"));
        }
        let output = identity::FUN
            .execute(&inputs.input.as_bytes(context), inputs.gas_limit, inputs.reservoir)
            .map_err(|error| error.to_string())?;
        Ok(Some(precompile_output_to_interpreter_result(output, inputs.gas_limit)))
    }

    fn warm_addresses(&self) -> &AddressSet {
        &self.addresses
    }
}
