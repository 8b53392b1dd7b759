// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults on purpose, for tests: named points of the program where it can be made to die, hang or hear of an I/O error.
/// Only in builds with VITRINE_FAULTS (the dev preset and those of sanitizers); elsewhere these functions do nothing at
/// all.
///
/// The variable VITRINE_FAULT lists ACTION@POINT[/OF][#N] with ';' between them: at the N-th (1) time that a process
/// comes to POINT, on behalf of OF (a model's path; none: any), it does
///     kill segv bus abort overflow loop sleep fork alloc leak exit close throw   as their names say
///     garble                                                                  hands on noise in place of a result
///     enospc eio                                                              fails the system call there
/// With VITRINE_FAULT_ONCE=FOLDER each does so once, in whichever process comes first.

#include <cstddef>
#include <string_view>
#include <vector>

namespace vitrine::io {

void fault(std::string_view point, std::string_view of = {});
/// The error that a system call is to fail with; 0: none.
int injected_error(std::string_view point);
void garble(std::string_view point, std::string_view of, std::vector<std::byte>& bytes);

}  // namespace vitrine::io
