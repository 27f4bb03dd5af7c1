// A slider that moves by itself and tells its values by the short way of live.js: what it has to do with the
// page's other elements waits until it is let go.
export default {
  template: `<q-slider ref="qRef" dense :model-value="at" :min="min" :max="max" :step="step" :aria-label="label"
    @update:model-value="move" @change="done"></q-slider>`,
  props: { value: Number, said: String, turn: Number, min: Number, max: Number, step: Number, label: String, whole: Boolean },
  data() { return { at: this.value, held: false }; },
  watch: {
    turn() {
      if (this.held) return;
      this.at = this.value;
      this.$nextTick(() => this.say(this.said));
    },
  },
  methods: {
    number() { return Number(this.$el.id.slice(1)); },
    say(words) {
      const field = this.$el.closest(".control")?.querySelector(".q-field input");
      if (field && field !== document.activeElement) field.value = words;
    },
    move(value) {
      this.held = true;
      this.at = value;
      this.say(this.whole ? String(Math.round(value)) : String(Number(value.toPrecision(6))));
      studioLive.slide(this.number(), value, false);
    },
    done(value) {
      this.held = false;
      studioLive.slide(this.number(), value, true);
      studio.letGo();
    },
  },
};
