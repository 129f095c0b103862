/** A value or bytes that are wrong. The message is one line: what, where, and what would be right. */
export class InputError extends Error {
    override name = "InputError";
}
