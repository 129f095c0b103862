"""shackled token"""
