// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one exception that stages and io throw on purpose. The graph adds the model's and the stage's name.

#include <stdexcept>
#include <string>
#include <utility>

namespace vitrine {

enum class ErrorKind {
  invalid_input,   ///< the file is damaged or says something impossible
  unsupported,     ///< valid, but not read here
  limit_exceeded,  ///< larger than the limits allow
  no_solution,     ///< an algorithm met a case it cannot solve
  broken           ///< our own fault
};

/// what(): what happened, with the value and the limit, lower case, no full stop. remedy: what the user can do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string const& what, std::string remedy)
      : std::runtime_error(what), kind_(kind), remedy_(std::move(remedy)) {}
  ErrorKind kind() const { return kind_; }
  std::string const& remedy() const { return remedy_; }

 private:
  ErrorKind kind_;
  std::string remedy_;
};

}  // namespace vitrine
