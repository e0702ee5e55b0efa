// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/command_line/command.hpp>

namespace tactus::host
{

/// Each of these adds a command, with options and examples, to the program.
void addNodes (const Command&);
void addValidate (const Command&);
void addSchema (const Command&);
void addCheck (const Command&);
void addCheckPreset (const Command&);
void addLimitsOf (const Command&);
void addRender (const Command&);
void addSpectrogram (const Command&);
void addSweep (const Command&);
void addPlay (const Command&);
void addSet (const Command&);
void addHit (const Command&);
void addProbe (const Command&);
void addDevices (const Command&);
void addFakeDevice (const Command&);
void addSession (const Command&);
void addBench (const Command&);
void addFit (const Command&);
void addNewNode (const Command&);
void addCurve (const Command&);
void addCheckPlugin (const Command&);
void addExport (const Command&);
void addConvert (const Command&);
void addImportData (const Command&);
void addExperiment (const Command&);
void addMark (const Command&);
void addStudy (const Command&);
void addCapture (const Command&);
void addTest (const Command&);
void addReport (const Command&);

}   // namespace tactus::host
