// SPDX-License-Identifier: Apache-2.0
// The bundler's loader: a style sheet is its text.
declare module '*.css' {
  const text: string;
  export default text;
}
