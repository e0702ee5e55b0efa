// SPDX-License-Identifier: MIT
#include "setting.hpp"

namespace tactus
{

SettingValue::SettingValue() noexcept = default;
SettingValue::SettingValue (const SettingValue&) = default;
SettingValue::SettingValue (SettingValue&&) noexcept = default;
SettingValue& SettingValue::operator= (const SettingValue&) = default;
SettingValue& SettingValue::operator= (SettingValue&&) noexcept = default;
SettingValue::~SettingValue() = default;

}   // namespace tactus
