// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options are written once. Each options struct has
///     template <class Self, class Visitor> static void fields(Self& self, Visitor&& visit)
/// which calls visit(self.member, Field{...}) for each member. The command line, its help, range checks, the report and
/// docs/options.md are visitors; the member's type (int, double, bool or an enum with EnumNames) decides how it is
/// shown.

#include <array>
#include <string_view>

namespace vitrine {

struct Field {
  std::string_view flag;  ///< "triangles" for --triangles; also the key in the report
  std::string_view unit;  ///< "texels"; empty for flags and choices
  std::string_view help;  ///< lower case, no full stop
  double low = 0, high = 0;
};

/// Specialise beside each enum: static constexpr std::array<std::string_view, N> names, in the order of the values from
/// 0.
template <class Enum>
struct EnumNames;

}  // namespace vitrine
