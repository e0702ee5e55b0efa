// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What C++ made by Faust expects to find; none of it does anything here.

#define FAUSTFLOAT double

struct dsp
{
    virtual ~dsp() = default;
};

struct Meta
{
    void declare (const char*, const char*) {}
};

struct UI
{
    void openVerticalBox (const char*) {}
    void closeBox() {}
};
