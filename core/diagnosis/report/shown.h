#pragma once

#include <string>
#include <string_view>

#include "core/base/shown_number.h"
#include "core/base/table.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

using base::shownNumber;
using base::ShownUnit;
using base::shownUnit;

/// Parameter of an effect with its name, "half width 0.420 ± 0.031 mm". Shares are in "%" and say of what:
/// "increase of the link radius 0.42 ± 0.03 %"; joint numbers and yes/no values (1 or 0) have no unit.
std::string shownParameter(std::string_view effect, const FoundParameter& parameter);
/// The same without the name: "0.420 ± 0.031 mm"; of a revolute joint's cable "0.420 ± 0.031 mm of cable
/// (0.408 ± 0.030 deg at the joint)".
std::string shownValue(const FoundParameter& parameter);
/// Name of a parameter in words: "half width".
std::string shownName(std::string_view parameter);
/// The same of an effect's parameter, which says what a share is a share of.
std::string shownName(std::string_view effect, std::string_view parameter);

/// Location of an effect: "joint 2"; for joint 0 "whole arm" or "cameras".
std::string shownJoint(std::string_view effect, int joint);

/// Share of a variance in words: "nearly all of it", "about half of it" … "no significant part of it".
std::string shareWords(double share);
/// The same for a signature; a share below two of its standard deviations counts as zero.
std::string shareWords(const Signature& signature);

/// Column of a table whose cells are words.
base::TableColumn textColumn(std::string name);

}  // namespace capstan::diagnosis
