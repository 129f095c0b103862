// What keys and the pointer do.

import { KEYS, POINTER } from "../ui/keys.js";

export function Keys() {
    return (
        <div class="keys">
            {[...POINTER, ...KEYS].map(({ shown, text }) => (
                <div key={text}>
                    <span>{text}</span>
                    <kbd>{shown}</kbd>
                </div>
            ))}
        </div>
    );
}
