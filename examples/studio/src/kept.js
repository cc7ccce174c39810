// Objects of the library that are kept for undo, the current one among them.

const MOST_KEPT = 24;

export class Kept {
  #of = new Map();             // number of a state -> its object
  now = null;

  get(number) { return this.#of.get(number); }

  #isKept(object) { return [...this.#of.values()].includes(object); }

  /** Makes an object the current one, kept under a number if there is one; what nobody has then is freed. */
  become(next, number) {
    if (this.now !== null && this.now !== next && !this.#isKept(this.now)) this.now.free();
    this.now = next;
    if (number !== undefined) this.#of.set(number, next);
    while (this.#of.size > MOST_KEPT) {
      const [oldest, its] = this.#of.entries().next().value;
      this.#of.delete(oldest);
      if (its !== next && !this.#isKept(its)) its.free();
    }
  }
}
