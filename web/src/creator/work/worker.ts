// The worker: it keeps contracts and meshes, and answers one request after the other.

import { serve } from "../../workers/serve.js";
import { Host } from "./host.js";
import { handlersOf } from "./handlers.js";

const host = new Host();
serve(handlersOf(host), host.keep, () => host.compile());
