// The source that the precompiled headers of the modules are made for.
