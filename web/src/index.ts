export { InputError } from "./errors.js";
export { encode, type FunctionName } from "./scene/encode.js";
export { parseScene } from "./scene/file.js";
export { halfHeightOf } from "./scene/staging.js";
export type * from "./scene/types.js";
export { describeCall, resizeCall, turnCall, type CallFacts, type Turn } from "./turn.js";
