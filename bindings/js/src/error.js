// The error that a failed call throws.
import { constantNames } from './names.js';

const CODES = constantNames('ICC_ERR_');

/** The name of a status: 'OK', 'ARGUMENT', 'OUTSIDE', ... */
export const codeOf = (status) => (status === 0 ? 'OK' : CODES.get(status) ?? 'UNKNOWN');

export class IccError extends Error {
  /** status: the number of the status; details: the members of icc_error, or nothing. */
  constructor(status, details = {}) {
    super(details.message || `ICC_ERR_${codeOf(status)}`);
    this.name = 'IccError';
    this.code = codeOf(status);
    this.index = details.index ?? -1;
    this.item = details.item ?? 'none';
    this.side = [null, 'source', 'target'][details.side ?? 0] ?? null;
  }

  /** The same error, blamed on a side unless it has one. */
  blame(side) {
    if (this.code === 'CANCELLED' || this.code === 'MEMORY' || this.side !== null) return this;
    return Object.assign(this, { message: `${side}: ${this.message}`, side });
  }

  /** Its members, for sending to another thread. */
  get plain() {
    const { message, code, index, item, side } = this;
    return { message, code, index, item, side };
  }

  static fromPlain(plain) { return Object.assign(new IccError(0, plain), plain); }
}
