/* Converts the strings of JSON to UTF-8. */
#ifndef JSON_DECODE_H
#define JSON_DECODE_H

/* Writes the contents of a string that json_scan_next() found, with quotes at begin[0] and end[-1],
 * and a '\0' behind them. `out` needs end - begin bytes and may be `begin`. An escaped U+0000 becomes
 * the two bytes c0 80, which are no other character in UTF-8. Returns NULL, or why it is no text. */
const char *json_decode(char *out, const char *begin, const char *end);

/* The value of a hexadecimal digit, or -1. */
int json_hex_digit(char c);

#endif
