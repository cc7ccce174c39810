// What can be undone: a list of states that are never changed, and where one is in it.

const MOST = 200;

export class History {
  #states; #at = 0;

  constructor(first) { this.#states = [first]; }

  get now() { return this.#states[this.#at]; }
  get canUndo() { return this.#at > 0; }
  get canRedo() { return this.#at + 1 < this.#states.length; }

  /** A new state; what had been undone is forgotten. */
  push(state) {
    this.#states.length = this.#at + 1;
    this.#states.push(state);
    if (this.#states.length > MOST) this.#states.shift();
    this.#at = this.#states.length - 1;
    return state;
  }

  /** Forgets the newest state; the one before it. */
  withdraw() {
    this.#states.length = this.#at;
    --this.#at;
    return this.now;
  }

  undo() { if (this.canUndo) --this.#at; return this.now; }
  redo() { if (this.canRedo) ++this.#at; return this.now; }
}
