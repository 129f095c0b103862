// HTML that the server made, which stays as it is. NiceGUI's own element for it compiles a template, which the security
// policy of the page forbids.
export default {
  props: { markup: String },
  render() {
    return globalThis.Vue.h("div", { style: "display:contents", innerHTML: this.markup });
  },
};
