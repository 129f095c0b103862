// The contracts that draw.

/** The Renderer and what it calls, in the order in which they are deployed. */
export const RENDERER = [
    "Engine",
    "FragmentEngine",
    "AntialiasedEngine",
    "AntialiasedFragmentEngine",
    "AntialiasedSmoothEngine",
    "EffectsEngine",
    "Effects",
    "Renderer",
] as const;
export type ContractName = (typeof RENDERER)[number] | "Studio";
