/** A bundled script, as text: web/build.mjs. */
declare module "worker:*" {
    const script: string;
    export default script;
}
