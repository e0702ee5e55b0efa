// SPDX-License-Identifier: MIT
#include "card.hpp"
#include "jack_messages.hpp"

#include <tactus/text/list_text.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>

#include <juce_audio_devices/juce_audio_devices.h>

#include <algorithm>
#include <cmath>

namespace tactus::host::audio
{
namespace
{
using Type = juce::AudioIODeviceType;

std::string textOf (const juce::String& s) { return s.toStdString(); }

std::vector<std::string> textsOf (const juce::StringArray& all)
{
    std::vector<std::string> texts;
    for (const auto& s : all)
        texts.push_back (textOf (s));
    return texts;
}

/// The card types of this system. JACK (and PipeWire) comes first, because a running server owns the cards.
std::vector<std::unique_ptr<Type>> makeTypes()
{
    std::vector<std::unique_ptr<Type>> types;
    for (auto* type : { Type::createAudioIODeviceType_JACK(), Type::createAudioIODeviceType_ALSA(), Type::createAudioIODeviceType_CoreAudio(),
                        Type::createAudioIODeviceType_WASAPI (juce::WASAPIDeviceMode::exclusive),
                        Type::createAudioIODeviceType_WASAPI (juce::WASAPIDeviceMode::shared), Type::createAudioIODeviceType_ASIO() })
        if (type != nullptr) types.emplace_back (type);
    return types;
}

/// Finds a name, or else the first name that contains the text. Without a text, prefers `system`, JACK's name for the card.
/// Empty if nothing matches.
juce::String nameLike (const std::string& wanted, const juce::StringArray& names)
{
    const auto text = juce::String (wanted);
    if (text.isNotEmpty() && names.contains (text)) return text;
    if (text.isEmpty()) return names.contains ("system") ? juce::String ("system") : names[0];
    for (const auto& name : names)
        if (name.containsIgnoreCase (text)) return name;
    return {};
}

juce::BigInteger first (int channels)
{
    juce::BigInteger all;
    all.setRange (0, channels, true);
    return all;
}

class JuceCard final : public OpenCard, private juce::AudioIODeviceCallback
{
public:
    JuceCard (std::unique_ptr<Type> t, std::unique_ptr<juce::AudioIODevice> d, CardUser& u) : type (std::move (t)), device (std::move (d)), user (u) {}
    ~JuceCard() override
    {
        device->stop();
        device->close();
    }

    void start() { device->start (this); }
    std::uint64_t xruns() const noexcept override { return static_cast<std::uint64_t> (std::max (0, device->getXRunCount())); }

private:
    void audioDeviceIOCallbackWithContext (const float* const* in, int ins, float* const* out, int outs, int frames,
                                           const juce::AudioIODeviceCallbackContext&) override
    {
        user.block (in, ins, out, outs, frames);
    }
    void audioDeviceAboutToStart (juce::AudioIODevice*) override {}
    void audioDeviceStopped() override {}

    juce::ScopedJuceInitialiser_GUI juce_runs;   // makes this thread JUCE's message thread, if there is none yet
    std::unique_ptr<Type> type;                  // the device calls into it
    std::unique_ptr<juce::AudioIODevice> device;
    CardUser& user;
};

class JuceCards final : public CardSystem
{
public:
    std::vector<std::string> types() override
    {
        const juce::ScopedJuceInitialiser_GUI juce_runs;
        std::vector<std::string> names;
        for (const auto& type : makeTypes())
            names.push_back (textOf (type->getTypeName()));
        return names;
    }

    std::vector<ListedCard> list() override
    {
        const juce::ScopedJuceInitialiser_GUI juce_runs;
        hushJack();
        std::vector<ListedCard> all;
        for (const auto& type : makeTypes())
        {
            type->scanForDevices();
            auto names = type->getDeviceNames (false);
            const auto inputs = type->getDeviceNames (true);
            for (const auto& name : inputs)
                names.addIfNotAlreadyThere (name);
            for (const auto& name : names)
            {
                const bool plays = type->getDeviceNames (false).contains (name);
                all.push_back (look (*type, plays ? name : juce::String(), inputs.contains (name) ? name : juce::String()));
            }
        }
        return all;
    }

    Result<std::unique_ptr<OpenCard>> open (const CardRequest&, int outputs, int inputs, CardUser&) override;

private:
    static ListedCard look (Type& type, const juce::String& output, const juce::String& input)
    {
        ListedCard card { .type = textOf (type.getTypeName()), .name = textOf (output.isNotEmpty() ? output : input) };
        const std::unique_ptr<juce::AudioIODevice> device (type.createDevice (output, input));
        if (! device)
        {
            card.trouble = "it cannot be opened";
            return card;
        }
        card.outputs = textsOf (device->getOutputChannelNames());
        card.inputs = textsOf (device->getInputChannelNames());
        for (const double rate : device->getAvailableSampleRates())
            card.rates.push_back (rate);
        for (const int block : device->getAvailableBufferSizes())
            card.blocks.push_back (block);
        return card;
    }
};

Message cannot (const char* id, std::string text, std::string remedy)
{
    return Message::error (std::string ("audio/") + id, "", std::move (text), std::move (remedy));
}

template <typename Numbers>
std::string listOf (const Numbers& numbers)
{
    std::string text;
    for (const auto n : numbers)
        addToList (text, numberText (static_cast<double> (n)));
    return text;
}

std::string cardsThere (const std::vector<std::unique_ptr<Type>>& types)
{
    std::string text;
    for (const auto& type : types)
    {
        auto names = type->getDeviceNames (false);
        names.addArray (type->getDeviceNames (true));
        names.removeDuplicates (false);
        for (const auto& name : names)
            addToList (text, textOf (type->getTypeName()) + ":" + textOf (name));
    }
    return text.empty() ? "no sound card was found; plug one in, or start a JACK or PipeWire server" : "available: " + text;
}

/// A card that matches a request. `type` is null if there is none.
struct CardChoice
{
    std::unique_ptr<Type> type;
    juce::String output, input;

    std::string name() const { return textOf (output.isNotEmpty() ? output : input); }
};

CardChoice choose (std::vector<std::unique_ptr<Type>>& types, const CardRequest& wanted, int outputs, int inputs)
{
    for (auto& type : types)
    {
        if (! wanted.type.empty() && ! type->getTypeName().equalsIgnoreCase (juce::String (wanted.type))) continue;
        const auto output = outputs > 0 ? nameLike (wanted.output, type->getDeviceNames (false)) : juce::String();
        const auto ins = type->getDeviceNames (true);
        auto input_name = wanted.input;
        if (input_name.empty()) input_name = output.isNotEmpty() && ins.contains (output) ? textOf (output) : wanted.output;   // prefers the card of the output
        const auto input = inputs > 0 ? nameLike (input_name, ins) : juce::String();
        if ((outputs == 0 || output.isNotEmpty()) && (inputs == 0 || input.isNotEmpty())) return { std::move (type), output, input };
    }
    return {};
}

Result<std::unique_ptr<OpenCard>> JuceCards::open (const CardRequest& wanted, int outputs, int inputs, CardUser& user)
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    hushJack();
    auto types = makeTypes();
    for (const auto& type : types)
        type->scanForDevices();

    const auto cards = cardsThere (types);
    auto chosen = choose (types, wanted, outputs, inputs);
    if (! chosen.type)
    {
        std::string what = "there is no " + (wanted.type.empty() ? std::string ("sound card") : wanted.type + " card");
        if (! wanted.output.empty()) what += " " + quote (wanted.output);
        if (inputs > 0 && ! wanted.input.empty()) what += " with an input " + quote (wanted.input);
        return cannot ("no_card", what, cards);
    }

    std::unique_ptr<juce::AudioIODevice> device (chosen.type->createDevice (chosen.output, chosen.input));
    const auto type_name = textOf (chosen.type->getTypeName()), name = type_name + ":" + chosen.name();
    if (! device) return cannot ("cannot_open", name + " cannot be opened", "check that no other program has exclusive access to it");

    const auto lacks = [&] (const juce::StringArray& channels, const char* kind, int needed) {
        return cannot ("channel", name + " has " + std::to_string (channels.size()) + kind + ", but channel " + std::to_string (needed) + " was requested",
                       "use one of its channels, or another card; " + cards);
    };
    if (const auto has = device->getOutputChannelNames(); outputs > has.size()) return lacks (has, " outputs", outputs);
    if (const auto has = device->getInputChannelNames(); inputs > has.size()) return lacks (has, " inputs", inputs);

    const auto rates = device->getAvailableSampleRates();
    const auto same = [] (double a, double b) { return std::abs (a - b) < 0.5; };
    if (wanted.rate_hz > 0.0 && std::ranges::none_of (rates, [&] (double r) { return same (r, wanted.rate_hz); }))
        return cannot ("rate", name + " does not run at " + numberText (wanted.rate_hz) + " Hz", "choose one of its rates: " + listOf (rates));
    double rate = wanted.rate_hz;
    if (rate == 0.0) rate = rates.isEmpty() || rates.contains (48000.0) ? 48000.0 : rates[0];
    int block = wanted.block > 0 ? wanted.block : device->getDefaultBufferSize();
    const auto blocks = device->getAvailableBufferSizes();
    if (wanted.block > 0 && ! blocks.contains (block))
        return cannot ("block", name + " does not run with blocks of " + std::to_string (block) + " frames",
                       "choose one of its block sizes: " + listOf (blocks));

    if (const auto trouble = device->open (first (inputs), first (outputs), rate, block); trouble.isNotEmpty())
        return cannot ("cannot_open", name + " cannot be opened: " + textOf (trouble),
                       "check that no other program has exclusive access to it, and that it runs at " + numberText (rate) + " Hz");
    rate = device->getCurrentSampleRate();
    block = device->getCurrentBufferSizeSamples();
    if (wanted.rate_hz > 0.0 && ! same (rate, wanted.rate_hz))
        return cannot ("rate", name + " was set to " + numberText (wanted.rate_hz) + " Hz but runs at " + numberText (rate) + " Hz",
                       "leave out the rate, or set it in the card or its server");
    if (rate <= 0.0 || block <= 0) return cannot ("cannot_open", name + " reports no rate or no block size", "check that its server is running");

    user.begin ({ type_name, chosen.name(), rate, block, outputs, inputs, device->getOutputLatencyInSamples() / rate });
    auto card = std::make_unique<JuceCard> (std::move (chosen.type), std::move (device), user);
    card->start();
    return std::unique_ptr<OpenCard> (std::move (card));
}
}   // namespace

CardSystem& soundCards()
{
    static JuceCards cards;
    return cards;
}

}   // namespace tactus::host::audio
