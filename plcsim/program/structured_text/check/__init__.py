"""From syntax trees and scopes to typed trees, with findings."""
