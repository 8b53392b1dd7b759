// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which model takes the worker down: those that were in flight when it died are run again one at a time, and the one
/// that dies alone is it.

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace vitrine::graph {

class Suspects {
 public:
  /// A worker died with these under way. `stranger`: by a signal that neither the worker nor the guard had a reason
  /// for (the machine's memory killer, an operator): then dying alone once may be chance. Returns the one that is
  /// convicted.
  std::optional<std::string> died(std::set<std::string> const& in_flight, bool stranger) {
    for (std::string const& slug : in_flight) ++deaths_[slug];
    all_.insert(in_flight.begin(), in_flight.end());
    if (in_flight.size() != 1) return std::nullopt;
    std::string const& slug = *in_flight.begin();
    if (deaths_[slug] < (stranger ? 3 : 2)) return std::nullopt;
    all_.erase(slug);
    return slug;
  }
  void suspect(std::string const& slug) { all_.insert(slug); }
  void clear(std::string const& slug) { all_.erase(slug); }
  std::set<std::string> const& all() const { return all_; }

 private:
  std::map<std::string, int> deaths_;
  std::set<std::string> all_;
};

}  // namespace vitrine::graph
