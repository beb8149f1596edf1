// Lists the slowest tests at the end of a run.

const COUNT = 10;

export default class Slowest {
  #tests = [];

  onTestEnd(test, { duration }) {
    // Without the project and the browser.
    this.#tests.push([duration, test.titlePath().slice(2).join(" › ")]);
  }

  onEnd() {
    const slowest = this.#tests.sort(([a], [b]) => b - a).slice(0, COUNT);
    const lines = slowest.map(([duration, title]) => `${(duration / 1000).toFixed(1).padStart(7)} s  ${title}`);
    console.log(`\nThe slowest of ${this.#tests.length} tests:\n${lines.join("\n")}`);
  }
}
