// The headers that test programs share are precompiled with this source.
