// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus
{

/// A node type that computes several instances at once: its code and layout for packs of one width. The code needs a processor that has
/// vectors of this width (widestLanes()). All functions are called like the hooks of a node.
///
/// A pack holds the params and the state of `width` instances member by member. A member of the node is one word of 8 bytes for each lane:
/// a double; the number of a choice; or 0 or -1 for a bool.
struct LaneForm
{
    static constexpr std::size_t most_words = 64;

    std::size_t width = 0;                    ///< lanes of a pack; 0: there is no code for this width
    std::size_t size = 0, outputs_size = 0;   ///< bytes of a pack, and of its outputs
    std::size_t params = 0, state = 0;        ///< number of words
    std::uint32_t offsets[most_words] {};     ///< where the words of lane 0 are in a pack, in bytes: first those of the params, then those of the state
    void (*make) (void* pack, const void* settings) noexcept = nullptr;
    void (*update) (void* pack) noexcept = nullptr;   ///< null if the node has no coefficients

    /// Runs `count` packs. Each has `inputs` sources, and each source is a double for each lane, side by side.
    void (*tick) (void* packs, std::size_t count, const double* const* sources, std::size_t inputs, void* outputs) noexcept = nullptr;
};

/// The functions with which a node type runs in lanes: its forms, and those that move an instance into a lane and out of it.
struct NodeLanes
{
    static constexpr std::size_t most_forms = 3;

    LaneForm forms[most_forms] {};                                              ///< by rising width; those that this processor cannot run are empty
    bool (*fit) (const void* node) noexcept = nullptr;                          ///< true if the node can run in lanes with its params, settings and state
    const void* (*settings) (const void* node) noexcept = nullptr;              ///< null if the node has none
    void (*saveParams) (void* node, std::uint64_t* words) noexcept = nullptr;   ///< LaneForm::params words
    void (*saveState) (void* node, std::uint64_t* words) noexcept = nullptr;    ///< LaneForm::state words
    void (*restoreState) (void* node, const std::uint64_t* words) noexcept = nullptr;

    bool empty() const noexcept { return fit == nullptr; }

    /// The form of this width; null if there is none.
    const LaneForm* form (std::size_t width) const noexcept
    {
        for (const auto& f : forms)
            if (f.width == width && width > 0) return &f;
        return nullptr;
    }
};

/// The widest packs that this processor has: 8, 4 or 2. [any thread]
std::size_t widestLanes() noexcept;

/// The number of lanes that a run uses: widestLanes(), or fewer if the environment variable TACTUS_LANES says so. With 1, each node runs on its own.
/// [main thread]
std::size_t usualLanes() noexcept;

}   // namespace tactus
