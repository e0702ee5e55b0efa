# SPDX-License-Identifier: GPL-3.0-or-later
# tactus_add_juce (NAME MODULES MODULE... [FAST MODULE...])
#
# Adds a static library of these JUCE modules. JUCE's own targets compile a module and its dependencies into every target that
# links them; here each module is compiled once. A library that builds on another one links it and lists only the modules it adds.
#
# JUCE does not get tactus_options: we cannot fix its warnings, which is also why it is SYSTEM. It is compiled with -O1, because
# none of it runs on the tick thread and it compiles in half the time; modules that the bench measures get -O3.
function (tactus_add_juce name)
    cmake_parse_arguments (PARSE_ARGV 1 juce "" "" "MODULES;FAST")
    add_library (${name} STATIC)
    set_target_properties (${name} PROPERTIES UNITY_BUILD OFF)   # each file is a whole module
    target_compile_features (${name} PUBLIC cxx_std_17)
    foreach (module IN LISTS juce_MODULES juce_FAST)
        get_target_property (sources juce::${module} INTERFACE_JUCE_MODULE_SOURCES)
        target_sources (${name} PRIVATE ${sources})
        if (module IN_LIST juce_FAST)
            set_source_files_properties (${sources} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
        endif ()
        get_target_property (libraries juce::${module} INTERFACE_LINK_LIBRARIES)
        list (FILTER libraries EXCLUDE REGEX "^juce_[a-z_]+$")   # the modules it depends on; packages are juce::pkgconfig_...
        target_link_libraries (${name} PUBLIC ${libraries})
        target_compile_definitions (${name} PUBLIC $<TARGET_PROPERTY:juce::${module},INTERFACE_COMPILE_DEFINITIONS>)
        target_include_directories (${name} SYSTEM PUBLIC $<TARGET_PROPERTY:juce::${module},INTERFACE_INCLUDE_DIRECTORIES>)
    endforeach ()
    target_compile_options (${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    if (TACTUS_SANITIZE)
        target_compile_options (${name} PRIVATE -fno-sanitize=all)   # we cannot fix these errors either, and it compiles four times as fast
    endif ()
endfunction ()
