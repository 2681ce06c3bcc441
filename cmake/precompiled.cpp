// Source for which the precompiled headers of the modules are generated.
