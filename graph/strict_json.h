// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JSON that others may have written: the library casts any number to the integer that is asked for, which is undefined
/// for 1e51. Here a fraction, or a number that the type does not hold, is an error like a string in its place.

#include "stages/options.h"

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace vitrine::graph {

/// As the library does it, but for the types below.
template <class T, class = void>
struct StrictSerializer : nlohmann::adl_serializer<T> {};

/// Whole numbers that fit.
template <std::integral T>
requires(!std::same_as<T, bool>) struct StrictSerializer<T> : nlohmann::adl_serializer<T> {
  template <class Json>
  static void from_json(Json const& in, T& value) {
    bool const fits = in.is_number_unsigned()
                          ? std::in_range<T>(in.template get_ref<std::uint64_t const&>())
                          : in.is_number_integer() && std::in_range<T>(in.template get_ref<std::int64_t const&>());
    if (!fits) throw Json::type_error::create(302, "no whole number that fits: " + in.dump(), &in);
    nlohmann::from_json(in, value);
  }
};

/// As a number; one that stands for nothing is an error.
template <class Enum>
requires std::is_enum_v<Enum>
struct StrictSerializer<Enum> {
  template <class Json>
  static void to_json(Json& out, Enum value) {
    out = int(value);
  }
  template <class Json>
  static void from_json(Json const& in, Enum& value) {
    int const number = in.template get<int>();
    if constexpr (requires { EnumNames<Enum>::names; })
      if (number < 0 || number >= int(EnumNames<Enum>::names.size()))
        throw Json::other_error::create(501, "there is no choice " + in.dump(), &in);
    value = Enum(number);
  }
};

template <template <class, class, class...> class Object>
using StrictJsonOf = nlohmann::basic_json<Object, std::vector, std::string, bool, std::int64_t, std::uint64_t, double,
                                          std::allocator, StrictSerializer>;
using StrictJson = StrictJsonOf<std::map>;
using StrictOrderedJson = StrictJsonOf<nlohmann::ordered_map>;

}  // namespace vitrine::graph

/// A struct as an object of these members: NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE for StrictJson.
#define VITRINE_JSON_MEMBERS(Type, ...)                                                             \
  inline void to_json(vitrine::graph::StrictJson& nlohmann_json_j, Type const& nlohmann_json_t) {   \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))                        \
  }                                                                                                 \
  inline void from_json(vitrine::graph::StrictJson const& nlohmann_json_j, Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__))                      \
  }
