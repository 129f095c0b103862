// What is made of meshes and textures, which nobody changes, is made once.

/**
 * Return `make`, which returns what it made before where it is called again with the same key and the same `more`.
 *
 * most: of how many values of `more` it remembers what was made, the last ones; as long as the key lives.
 */
export function remembered<K extends object, V, A = void>(make: (key: K, more: A) => V, most = 4): typeof make {
    const made = new WeakMap<K, Map<A, V>>();
    return (key, more) => {
        const values = made.get(key) ?? new Map<A, V>();
        made.set(key, values);
        const value = values.has(more) ? (values.get(more) as V) : make(key, more);
        values.delete(more);
        values.set(more, value);
        for (const oldest of values.keys()) {
            if (values.size <= most) break;
            values.delete(oldest);
        }
        return value;
    };
}

/** Return `check`, which returns the same for a value that was checked before, and for what it returned itself. */
export function checkedOnce<G extends object, C extends G>(
    check: (value: G, where: string) => C,
): (value: G, where: string) => C {
    const checked = new WeakMap<G, C>();
    return (value, where) => {
        const known = checked.get(value);
        if (known) return known;
        const found = check(value, where);
        checked.set(value, found).set(found, found);
        return found;
    };
}
