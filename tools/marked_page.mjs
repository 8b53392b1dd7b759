// SPDX-License-Identifier: Apache-2.0
// Tables in Markdown, and pages of which a tool makes a part: what lies between "<!-- made by PROGRAM -->" and "<!-- end -->".
import fs from 'node:fs';

const line = (cells) => `| ${cells.join(' | ')} |`;

/** The first `words` columns are words, the others numbers. */
export function table(head, rows, words) {
  return [line(head), line(head.map((_, k) => (k < words ? '---' : '--:'))), ...rows.map(line)].join('\n');
}

export function putInto(page, program, text) {
  const whole = fs.readFileSync(page, 'utf8');
  const begin = `<!-- made by ${program} -->`;
  const from = whole.indexOf(begin), to = whole.indexOf('<!-- end -->', from);
  if (from < 0 || to < 0) throw new Error(`${page} lacks the lines ${begin} and <!-- end -->`);
  fs.writeFileSync(page, `${whole.slice(0, from + begin.length)}\n\n${text}\n\n${whole.slice(to)}`);
}
