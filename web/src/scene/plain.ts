// Checks of the fields of which the table of fields.ts says all, in scenes and in scene files.

import * as check from "./checks.js";
import { FIELDS, type Field, type InFile, type Plain } from "./fields.js";
import { snake, type Table } from "./table.js";

type Class = keyof typeof FIELDS;
type Described = Class & keyof Plain;
/** What a scene file may say of a class in plain fields. */
type Read<Name extends Described> = Partial<Plain[Name] & (Name extends keyof InFile ? InFile[Name] : unknown)>;

const KINDS: Readonly<
    Record<NonNullable<Field["kind"]>, (value: unknown, where: string, field: Required<Field>) => unknown>
> = {
    number: (value, where, { low, high }) => check.number(value, where, low, high),
    whole: (value, where, { low, high }) => check.whole(value, where, low, high),
    flag: check.flag,
    color: check.color,
    vector: check.vector,
    pair: (value, where) => check.numbers(value, where, 2),
    choice: (value, where, { choices }) => check.choice(value, where, choices),
};

function fieldsOf(name: Class): [string, Field][] {
    return Object.entries(FIELDS[name]);
}

function checkedField({ kind, ...field }: Field, value: unknown, where: string): unknown {
    return kind && KINDS[kind](value, where, field as Required<Field>);
}

/** The keys of scene files whose values are colours. */
export const COLOR_KEYS: ReadonlySet<string> = new Set(
    Object.values(FIELDS)
        .flatMap((fields) => Object.entries<Field>(fields))
        .flatMap(([key, { kind }]) => (kind === "color" ? [snake(key)] : []))
        .concat("background"),
);

/** Return the fields that a class has in scenes. */
export function namesOf(name: Class): string[] {
    return fieldsOf(name).flatMap(([key, { only }]) => (only === "file" ? [] : [key]));
}

/** Return the keys that a class has in scene files. */
export function keysOf(name: Class): string[] {
    return fieldsOf(name).flatMap(([key, { only }]) => (only === "class" ? [] : [snake(key)]));
}

/** Return the plain fields of a value of a class, all of them. InputError for one that is wrong or not known. */
export function plain<Name extends Described>(name: Name, value: object, where: string): Plain[Name] {
    const given: Record<string, unknown> = check.fields(value, where || "the scene", namesOf(name) as never[]) as never;
    const found = fieldsOf(name).flatMap(([key, field]) => {
        if (!field.kind || field.only === "file") return [];
        const own = given[key] ?? field.usual ?? given[key];
        const isAbsent = own === undefined && !field.needed;
        return [[key, isAbsent ? undefined : checkedField(field, own, where ? `${where}.${key}` : key)]];
    });
    return Object.fromEntries(found) as Plain[Name];
}

/** Return the plain fields of a class that a table of a scene file has. */
export function read<Name extends Described>(name: Name, keys: Table): Read<Name> {
    const found = fieldsOf(name).flatMap(([key, field]) => {
        if (!field.kind || field.only === "class" || !keys.has(snake(key))) return [];
        return [[key, keys.read(snake(key), (value, where) => checkedField(field, value, where))]];
    });
    return Object.fromEntries(found) as Read<Name>;
}
