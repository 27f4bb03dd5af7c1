// A small picture of the library, asked for when it is seen. Browsers ask few things at once of one server, and a
// picture that was never drawn takes a while: so there are never more than two on their way, the newest first.
const AT_ONCE = 2, waiting = [], made = new WeakMap();
let busy = 0;

const seen = new IntersectionObserver((entries) => {
  for (const each of entries.filter((entry) => entry.isIntersecting).reverse()) {
    seen.unobserve(each.target);
    waiting.push(each.target);
  }
  next();
}, { rootMargin: "160px" });

function next() {
  while (busy < AT_ONCE && waiting.length) {
    const image = waiting.pop();
    if (!image.isConnected) continue;
    busy++;
    image.classList.add("drawing");
    image.onload = image.onerror = () => { image.classList.remove("drawing"); busy--; next(); };
    made.get(image).src = made.get(image).address;
  }
}

export default {
  template: '<img :src="src" alt="" decoding="async">',
  props: { address: String },
  data: () => ({ src: undefined }),
  mounted() { made.set(this.$el, this); seen.observe(this.$el); },
  unmounted() { seen.unobserve(this.$el); },
};
