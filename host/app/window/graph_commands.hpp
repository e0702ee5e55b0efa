// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/desk.hpp>

namespace tactus::host
{

/// Commands of the menu for the open graph. [main thread]
void savePictureAs (const Desk&);                          ///< asks where
void shareAs (const Desk&);                                ///< as one file, with those that it names; asks where
void randomise (const Desk&);                              ///< new values for the selected nodes, or for all of the patch
void openExample (const Desk&, const std::string& type);   ///< a small graph with a node of this type

}   // namespace tactus::host
