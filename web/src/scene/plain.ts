// Checks of the fields of which the table of fields.ts says all, in scenes and in scene files.

import * as check from "./checks.js";
import { FIELDS, type InFile, type Plain } from "./fields.js";
import { snake, type Table } from "./table.js";

/** A field of a class; one without a kind is checked by hand. */
export interface Field {
    readonly kind?: "number" | "whole" | "flag" | "color" | "vector" | "pair" | "choice";
    readonly limits?: readonly number[];
    readonly choices?: readonly string[];
    readonly default?: unknown;
    readonly needed?: boolean;
    /** Of a key of scene files that is no field, or of a field that is no key. */
    readonly only?: "file" | "class";
}
type Class = keyof typeof FIELDS;
type Described = Class & keyof Plain;
/** What a scene file may say of a class in plain fields. */
type Read<Name extends Described> = Partial<Plain[Name] & (Name extends keyof InFile ? InFile[Name] : unknown)>;

function fieldsOf(name: Class): [string, Field][] {
    return Object.entries(FIELDS[name]);
}

function checkedField({ kind, limits = [], choices = [] }: Field, value: unknown, where: string): unknown {
    const [low = -Infinity, high = Infinity] = limits;
    if (kind === "number" || kind === "whole") return check[kind](value, where, low, high);
    if (kind === "choice") return check.choice(value, where, choices);
    return kind === "pair" ? check.numbers(value, where, 2) : kind && check[kind](value, where);
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
        const own = given[key] ?? field.default ?? given[key];
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
