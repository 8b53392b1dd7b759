// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Visitors over the options structs of stages and io (stages/options.h): command line, report and documentation follow
/// from them.

#include "stages/options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <type_traits>

namespace vitrine::tools {

/// An enum's value or a number, as --help, the report and the documentation show it.
template <class T>
std::string shown(T const& value) {
  if constexpr (std::is_enum_v<T>)
    return std::string(EnumNames<T>::names[static_cast<std::size_t>(value)]);
  else
    return nlohmann::json(value).dump();
}

/// "a|b|c" for an enum, "" for anything else.
template <class T>
std::string choices() {
  std::string text;
  if constexpr (std::is_enum_v<T>)
    for (std::string_view name : EnumNames<T>::names) text += (text.empty() ? "" : "|") + std::string(name);
  return text;
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
      std::map<std::string, T> names;
      for (std::size_t i = 0; i < EnumNames<T>::names.size(); ++i)
        names[std::string(EnumNames<T>::names[i])] = static_cast<T>(i);
      option = app_.add_option(flag, value, std::string(field.help))
                   ->transform(CLI::CheckedTransformer(names).description(""))
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

/// All options of a set of groups (see graph::option_groups) as one JSON object by flag.
template <class Groups, class Options>
nlohmann::ordered_json options_json(Options const& options, Groups const& groups) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  groups(options, [&](std::string_view, auto const& group) {
    group.fields(group, [&](auto const& value, Field const& field) {
      if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
        out[std::string(field.flag)] = shown(value);
      else
        out[std::string(field.flag)] = value;
    });
  });
  return out;
}

}  // namespace vitrine::tools
