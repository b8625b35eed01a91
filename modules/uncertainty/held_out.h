#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "saker/uncertainty/class_model.h"

namespace saker::uncertainty {

/// One figure a recording, each from a fit that had not seen it.
using HeldOut = std::map<std::string, double>;

/// Parts `recordings` into folds and gives `score` each in turn: which recordings are held out; the
/// scores it returns are put together.
[[nodiscard]] HeldOut held_out(
    std::vector<std::string> recordings, int folds,
    const std::function<HeldOut(const std::function<bool(const std::string&)>& is_held_out)>&
        score);

/// Is `better` greater than `worse` by so many standard errors of the mean difference?
[[nodiscard]] Trial trial(const std::string& what, const HeldOut& better, const HeldOut& worse,
                          double standard_errors);

}  // namespace saker::uncertainty
