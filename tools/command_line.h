// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Visitor over the options structs of stages and io (stages/options.h): the command line follows from them.

#include "graph/options_json.h"

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <type_traits>

namespace vitrine::tools {

using graph::shown;

/// "a|b|c" for an enum, "" for anything else.
template <class T>
std::string choices() {
  std::string text;
  if constexpr (std::is_enum_v<T>)
    for (std::string_view name : EnumNames<T>::names) text += (text.empty() ? "" : "|") + std::string(name);
  return text;
}

/// An enum's values by name, for CLI11.
template <class T>
std::map<std::string, T> names() {
  std::map<std::string, T> found;
  for (std::size_t i = 0; i < EnumNames<T>::names.size(); ++i)
    found[std::string(EnumNames<T>::names[i])] = static_cast<T>(i);
  return found;
}

/// Adds a flag per field to a CLI11 command; defaults are those of the struct.
class AddFlags {
 public:
  AddFlags(CLI::App& app, std::string group) : app_(app), group_(std::move(group)) {}

  template <class T>
  void operator()(T& value, Field const& field) const {
    std::string const flag = "--" + std::string(field.flag);
    CLI::Option* option = nullptr;
    if constexpr (std::is_same_v<T, bool>) {
      option = app_.add_flag(flag + ",!--no-" + std::string(field.flag), value, std::string(field.help));
    } else if constexpr (std::is_enum_v<T>) {
      option = app_.add_option(flag, value, std::string(field.help))
                   ->transform(CLI::CheckedTransformer(names<T>()).description(""))
                   ->type_name(choices<T>())
                   ->default_str(shown(value));
    } else {
      option = app_.add_option(flag, value, std::string(field.help))
                   ->check(CLI::Range(static_cast<T>(field.low), static_cast<T>(field.high)).description(""))
                   ->type_name(std::string(field.unit))
                   ->capture_default_str();
    }
    option->group(group_);
  }

 private:
  CLI::App& app_;
  std::string group_;
};

}  // namespace vitrine::tools
